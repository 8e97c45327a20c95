#pragma once
// Reads point clouds from files, in double precision end to end.

#include <cstddef>
#include <filesystem>
#include <string>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// What reading a file met.
struct ReadReport {
    std::string format;                  ///< "PCD", "PLY", "OBJ" or "XYZ"
    std::size_t points = 0;              ///< points of the file, dropped ones included
    std::size_t dropped_non_finite = 0;  ///< points with NaN or infinity, left out (PCD and PLY only)
};

/// Reads a cloud; the extension, in any case, decides the format:
/// - .pcd (ascii, binary, binary_compressed) and .ply (ascii, binary of both byte orders) with x y z of any
///   numeric type; points with NaN or infinity are left out and counted;
/// - .obj: `v x y z` or `v x y z r g b`, other statements are skipped;
/// - .xyz .txt .asc .pts .csv: x y z and any further columns, separated by blanks, tabs, commas or
///   semicolons;
///   a header line, comments (# or //), empty lines and the count lines of .pts are skipped.
/// Throws IoError for a file that is missing, not readable, empty, without points, truncated or malformed,
/// for NaN and infinity in text, and for what is not read here (.las, .laz, .e57, range grids in PLY, ...).
/// [setup]
Cloud read_cloud(const std::filesystem::path& path, ReadReport* report = nullptr);

}  // namespace dsc::cloud
