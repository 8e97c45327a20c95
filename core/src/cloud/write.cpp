#include <dsc/cloud/write.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstring>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/base/replace_file.hpp>
#include <dsc/cloud/read.hpp>

#include "text.hpp"

namespace dsc::cloud {
namespace fs = std::filesystem;

namespace {

/// Shortest text that reads back as the same double.
void append(std::string& text, double value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    static_cast<void>(error);  // 32 characters hold every double
    text.append(digits, end);
}

void append_point(std::string& text, const Vec3& p) {
    append(text, p.x());
    text += ' ';
    append(text, p.y());
    text += ' ';
    append(text, p.z());
}

std::string obj_text(const Cloud& cloud, bool coloured) {
    std::string text;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        text += "v ";
        append_point(text, cloud.points[i]);
        if (coloured)
            for (const std::uint8_t c : cloud.colours[i]) {
                text += ' ';
                append(text, c / 255.0);
            }
        text += '\n';
    }
    return text;
}

std::string xyz_text(const Cloud& cloud, bool coloured) {
    std::string text;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        append_point(text, cloud.points[i]);
        if (coloured)
            for (const std::uint8_t c : cloud.colours[i]) text.append(" ").append(std::to_string(c));
        text += '\n';
    }
    return text;
}

/// Comma-separated values under the names of the columns.
std::string csv_text(const Cloud& cloud, bool coloured) {
    std::string text = coloured ? "x,y,z,red,green,blue\n" : "x,y,z\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            if (k > 0) text += ',';
            append(text, cloud.points[i][k]);
        }
        if (coloured)
            for (const std::uint8_t c : cloud.colours[i]) text.append(",").append(std::to_string(c));
        text += '\n';
    }
    return text;
}

void append_raw(std::string& bytes, const Vec3& p) {
    char raw[3 * sizeof(double)];
    std::memcpy(raw, p.data(), sizeof raw);
    bytes.append(raw, sizeof raw);
}

/// Binary doubles, colours packed as PCL does it: 0x00rrggbb in the four bytes of a "float".
std::string pcd_bytes(const Cloud& cloud, bool coloured) {
    const std::string count = std::to_string(cloud.points.size());
    std::string bytes = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z";
    bytes += coloured ? " rgb\nSIZE 8 8 8 4\nTYPE F F F F\nCOUNT 1 1 1 1" : "\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1";
    bytes += "\nWIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        append_raw(bytes, cloud.points[i]);
        if (!coloured) continue;
        const auto& [red, green, blue] = cloud.colours[i];
        const std::uint32_t packed = (std::uint32_t{red} << 16U) | (std::uint32_t{green} << 8U) | blue;
        char raw[sizeof packed];
        std::memcpy(raw, &packed, sizeof raw);
        bytes.append(raw, sizeof raw);
    }
    return bytes;
}

std::string ply_bytes(const Cloud& cloud, bool coloured) {
    const bool little = std::endian::native == std::endian::little;
    std::string bytes = "ply\nformat binary_" + std::string(little ? "little" : "big") +
                        "_endian 1.0\nelement vertex " + std::to_string(cloud.points.size()) +
                        "\nproperty double x\nproperty double y\nproperty double z\n";
    if (coloured) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    bytes += "end_header\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        append_raw(bytes, cloud.points[i]);
        if (coloured)
            for (const std::uint8_t c : cloud.colours[i]) bytes += static_cast<char>(c);
    }
    return bytes;
}

}  // namespace

void write_cloud(const fs::path& path, const Cloud& cloud) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool coloured = !cloud.points.empty() && cloud.colours.size() == cloud.points.size();
    if (extension == ".obj")
        replace_file(path, obj_text(cloud, coloured));
    else if (extension == ".xyz" || extension == ".txt" || extension == ".asc" || extension == ".pts")
        replace_file(path, xyz_text(cloud, coloured));
    else if (extension == ".ply")
        replace_file(path, ply_bytes(cloud, coloured));
    else if (extension == ".csv")
        replace_file(path, csv_text(cloud, coloured));
    else if (extension == ".pcd")
        replace_file(path, pcd_bytes(cloud, coloured));
    else
        throw IoError("io.format", path.string(), "",
                      extension.empty() ? "the file's name has no extension"
                                        : "clouds are not written as " + in_quotes(extension),
                      "accepted are " + std::string(cloud_extensions()));
}

}  // namespace dsc::cloud
