#pragma once
// Writes point clouds to files, in double precision.

#include <filesystem>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// Writes .obj, .ply or .pcd (binary, double), .csv (with a header) or .xyz .txt .asc .pts (x y z
/// per line); the extension decides. Text is the shortest that reads back to the same doubles.
/// Colours and normals are written if the cloud has them. Atomic: a file next to `path` is written
/// and renamed. Throws IoError. [setup]
void write_cloud(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace dsc::cloud
