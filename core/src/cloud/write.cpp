// Writes point clouds.
#include "dsc/cloud/write.hpp"

#include <bit>
#include <cstring>
#include <string>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/replace_file.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

namespace dsc::cloud {
namespace fs = std::filesystem;

namespace {

void append_point(std::string& text, const Vec3& p) {
    text::append_number(text, p.x());
    text += ' ';
    text::append_number(text, p.y());
    text += ' ';
    text::append_number(text, p.z());
}

/// The attributes that are written besides the points.
struct Whole {
    bool colours = false;
    bool normals = false;
};

void append_separated(std::string& text, const Vec3& v, char separator) {
    for (int k = 0; k < 3; ++k) {
        text += separator;
        text::append_number(text, v[k]);
    }
}

std::string obj_text(const Cloud& cloud, const Whole& whole) {
    std::string text;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        text += "v ";
        append_point(text, cloud.points[i]);
        if (whole.colours)
            for (const std::uint8_t c : cloud.colours[i]) {
                text += ' ';
                text::append_number(text, c / 255.0);
            }
        text += '\n';
    }
    if (!whole.normals) return text;
    for (const Vec3& normal : cloud.normals) {
        text += "vn ";
        append_point(text, normal);
        text += '\n';
    }
    return text;
}

std::string xyz_text(const Cloud& cloud, const Whole& whole) {
    std::string text;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        append_point(text, cloud.points[i]);
        if (whole.colours)
            for (const std::uint8_t c : cloud.colours[i])
                text.append(" ").append(std::to_string(c));
        if (whole.normals) append_separated(text, cloud.normals[i], ' ');
        text += '\n';
    }
    return text;
}

/// Comma-separated values with the names of the columns.
std::string csv_text(const Cloud& cloud, const Whole& whole) {
    std::string text = std::string("x,y,z") + (whole.colours ? ",red,green,blue" : "") +
                       (whole.normals ? ",nx,ny,nz" : "") + "\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            if (k > 0) text += ',';
            text::append_number(text, cloud.points[i][k]);
        }
        if (whole.colours)
            for (const std::uint8_t c : cloud.colours[i])
                text.append(",").append(std::to_string(c));
        if (whole.normals) append_separated(text, cloud.normals[i], ',');
        text += '\n';
    }
    return text;
}

void append_raw(std::string& bytes, const Vec3& p) {
    char raw[3 * sizeof(double)];
    std::memcpy(raw, p.data(), sizeof raw);
    bytes.append(raw, sizeof raw);
}

/// Binary doubles; colours are packed as PCL does it: 0x00rrggbb in the four bytes of a "float".
std::string pcd_bytes(const Cloud& cloud, const Whole& whole) {
    const std::string count = std::to_string(cloud.points.size());
    const std::string normals = whole.normals ? " normal_x normal_y normal_z" : "";
    std::string bytes = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z";
    bytes += (whole.colours ? " rgb" : "") + normals + "\nSIZE 8 8 8" +
             (whole.colours ? " 4" : "") + (whole.normals ? " 8 8 8" : "");
    bytes +=
        std::string("\nTYPE F F F") + (whole.colours ? " F" : "") + (whole.normals ? " F F F" : "");
    bytes += std::string("\nCOUNT 1 1 1") + (whole.colours ? " 1" : "") +
             (whole.normals ? " 1 1 1" : "");
    bytes += "\nWIDTH " + count + "\nHEIGHT 1\nVIEWPOINT";
    append_separated(bytes, cloud.sensor ? cloud.sensor->position : Vec3(Vec3::Zero()), ' ');
    bytes += " 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        append_raw(bytes, cloud.points[i]);
        if (whole.colours) {
            const auto& [red, green, blue] = cloud.colours[i];
            const std::uint32_t packed =
                (std::uint32_t{red} << 16U) | (std::uint32_t{green} << 8U) | blue;
            char raw[sizeof packed];
            std::memcpy(raw, &packed, sizeof raw);
            bytes.append(raw, sizeof raw);
        }
        if (whole.normals) append_raw(bytes, cloud.normals[i]);
    }
    return bytes;
}

std::string ply_bytes(const Cloud& cloud, const Whole& whole) {
    const bool little = std::endian::native == std::endian::little;
    std::string bytes = fmt::format("ply\nformat binary_{}_endian 1.0\nelement vertex {}\nproperty "
                                    "double x\nproperty double y\nproperty double z\n",
                                    little ? "little" : "big", cloud.points.size());
    if (whole.colours) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    if (whole.normals) bytes += "property double nx\nproperty double ny\nproperty double nz\n";
    bytes += "end_header\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        append_raw(bytes, cloud.points[i]);
        if (whole.colours)
            for (const std::uint8_t c : cloud.colours[i]) bytes += static_cast<char>(c);
        if (whole.normals) append_raw(bytes, cloud.normals[i]);
    }
    return bytes;
}

}  // namespace

void write_cloud(const fs::path& path, const Cloud& cloud) {
    const std::string extension = text::lower_case_extension(path);
    const auto one_each = [&](std::size_t size) {
        return !cloud.points.empty() && size == cloud.points.size();
    };
    const Whole whole{one_each(cloud.colours.size()), one_each(cloud.normals.size())};
    if (extension == ".obj")
        replace_file(path, obj_text(cloud, whole));
    else if (extension == ".xyz" || extension == ".txt" || extension == ".asc" ||
             extension == ".pts")
        replace_file(path, xyz_text(cloud, whole));
    else if (extension == ".ply")
        replace_file(path, ply_bytes(cloud, whole));
    else if (extension == ".csv")
        replace_file(path, csv_text(cloud, whole));
    else if (extension == ".pcd")
        replace_file(path, pcd_bytes(cloud, whole));
    else
        throw IoError("io.format", path.string(), "",
                      extension.empty()
                          ? "the file's name has no extension"
                          : "clouds cannot be written as " + text::in_quotes(extension),
                      "accepted are " + std::string(cloud_extensions()));
}

}  // namespace dsc::cloud
