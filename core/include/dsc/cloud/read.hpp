#pragma once
// Reads point clouds from files, in double precision.

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
    std::string use;  ///< "position", "normal", "colour", "colour (grey)"; empty if it is not used
};

/// What the reader found in a file.
struct ReadReport {
    std::string format;                  ///< "PCD", "PLY", "OBJ", "XYZ" or "CSV"
    std::size_t points = 0;              ///< points of the file, dropped ones included
    std::size_t dropped_non_finite = 0;  ///< points with NaN or infinity, left out (PCD and PLY
                                         ///< only)
    std::vector<FoundProperty> properties{};  ///< in the order of the file; empty if columns have
                                              ///< no names
};

/// Selects the columns of a text cloud that contain the coordinates and, with six columns, the
/// colours.
struct ReadOptions {
    /// 3 (x, y, z) or 6 (x, y, z, red, green, blue) names of the header, in upper or lower case, or
    /// numbers from 1. Empty: the columns that the header names, else the first three.
    std::vector<std::string> columns{};
};

/// Reads the bytes of a cloud's file. Messages name the file. Its extension, in upper or lower
/// case, decides the format:
/// - .pcd (ascii, binary, binary_compressed) and .ply (ascii, binary of both byte orders) with
///   x y z, normals, colours or intensities of any numeric type; points with NaN or infinity are
///   left out and counted;
/// - .obj: `v x y z` or `v x y z r g b`, and `vn` by the corners of `f` or one per point; other
///   statements are skipped;
/// - .xyz .txt .asc .pts .csv: columns separated by blanks, tabs, commas or semicolons, quoted or
///   not. The positions are the columns named x, y, z in a header line or in a comment before the
///   first point, else the first three. Colours come from r, g, b or red, green, blue; normals
///   come from nx, ny, nz or normal_x, ... If there are no colours, the intensity is read as grey.
///   Without such a header, columns 4 to 6 of six, and 7 to 9 of nine, are colours if they contain
///   only integers from 0 to 255 (at least one above 1), and normals if they are unit vectors in
///   every line. Comments (# or //), empty lines and the count lines of .pts are skipped.
///
/// A normal is scaled to a unit vector; a normal without a direction becomes zero. Whether normals
/// agree with the points is not tested here. Throws IoError for bytes that are empty, without
/// points, truncated or malformed, for NaN and infinity in text, for formats that are not supported
/// (.las, .laz, .e57, range grids in PLY, ...), and "io.columns" if the chosen columns are not 3 or
/// 6, do not exist, or the format has no columns. [setup]
Cloud parse_cloud(const std::filesystem::path& file, std::string bytes,
                  ReadReport* report = nullptr, const ReadOptions& options = {});

/// The same for a file. Also throws what read_file() throws. [setup]
Cloud read_cloud(const std::filesystem::path& path, ReadReport* report = nullptr,
                 const ReadOptions& options = {});

/// A cloud from arrays, as a file with the same columns would give it: normals as above. `normals`
/// and `colours` are empty or have one entry per point; `source` names the cloud in messages.
/// [setup]
Cloud cloud_of(std::vector<Vec3> points, std::vector<Vec3> normals, std::vector<Colour> colours,
               std::string source);

/// ".pcd .ply .obj .xyz .txt .asc .pts .csv": the extensions of read_cloud() and write_cloud().
/// [parallel]
std::string_view cloud_extensions();

/// Whether the extension, in upper or lower case, is one of them. [parallel]
bool is_cloud_file(const std::filesystem::path& path);

}  // namespace dsc::cloud
