#pragma once
// Reads point clouds from files, in double precision end to end.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// A column, field or property of a cloud's file.
struct FoundProperty {
    std::string name;
    std::string use;  ///< "position", "normal", "colour", "colour (grey)"; empty where it is not used
};

/// What reading a file met.
struct ReadReport {
    std::string format;                  ///< "PCD", "PLY", "OBJ", "XYZ" or "CSV"
    std::size_t points = 0;              ///< points of the file, dropped ones included
    std::size_t dropped_non_finite = 0;  ///< points with NaN or infinity, left out (PCD and PLY only)
    std::vector<FoundProperty> properties{};  ///< in the order of the file; empty where columns have no names
};

/// Which columns of a text cloud hold the coordinates, and the colours if there are six.
struct ReadOptions {
    /// 3 (x, y, z) or 6 (x, y, z, red, green, blue) names of the header, in any case, or numbers from 1; empty:
    /// by the header's names, else the first three.
    std::vector<std::string> columns{};
};

/// Reads the bytes of a cloud's file. Messages name the file, and its extension, in any case, decides the format:
/// - .pcd (ascii, binary, binary_compressed) and .ply (ascii, binary of both byte orders) with x y z, normals, colours or
///   intensities of any numeric type; points with NaN or infinity are left out and counted;
/// - .obj: `v x y z` or `v x y z r g b`, and `vn` as the corners of `f` say or one per point; other statements are skipped;
/// - .xyz .txt .asc .pts .csv: columns separated by blanks, tabs, commas or semicolons, quoted or not. Those
///   that a header line or a comment before the first point calls x, y, z, else the first three; colours from
///   r, g, b or red, green, blue, normals from nx, ny, nz or normal_x, ..., greys from intensity where there are no colours.
///   Without such a header columns 4 to 6 of six, and 7 to 9 of nine, are colours where they hold whole numbers from 0 to 255
///   (one above 1), normals where they are unit vectors in every line. Comments (# or //), empty lines and the count
///   lines of .pts are skipped.
/// A normal is scaled to a unit vector, one without a direction is zero; whether they agree with the points is not judged here.
/// Throws IoError for bytes that are empty, without points, truncated or malformed, for NaN and infinity in text, for what is not read here (.las, .laz, .e57, range grids in PLY, ...), and
/// "io.columns" for chosen columns that are not 3 or 6, not there, or of a format without columns. [setup]
Cloud parse_cloud(const std::filesystem::path& file, std::string bytes, ReadReport* report = nullptr, const ReadOptions& options = {});

/// The same for a file. Throws also what read_file() throws. [setup]
Cloud read_cloud(const std::filesystem::path& path, ReadReport* report = nullptr,
                 const ReadOptions& options = {});

/// ".pcd .ply .obj .xyz .txt .asc .pts .csv": what read_cloud() and write_cloud() take. [parallel]
std::string_view cloud_extensions();

/// Whether the extension, in any case, is one of them. [parallel]
bool is_cloud_file(const std::filesystem::path& path);

}  // namespace dsc::cloud
