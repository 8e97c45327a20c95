#pragma once
// Writes point clouds to files, in double precision.

#include <filesystem>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// Writes .xyz, .obj or .ply (binary, double), the extension decides; text has 17 digits, so reading it back
/// gives the same doubles. Colours are written where the cloud has them. Atomic: a file beside `path` is
/// written and renamed. Throws IoError. [setup]
void write_cloud(const std::filesystem::path& path, const Cloud& cloud);

}  // namespace dsc::cloud
