#include <dsc/cloud/write.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

#include <unistd.h>

#include <dsc/base/error.hpp>

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

std::string ply_bytes(const Cloud& cloud, bool coloured) {
    const bool little = std::endian::native == std::endian::little;
    std::string bytes = "ply\nformat binary_" + std::string(little ? "little" : "big") +
                        "_endian 1.0\nelement vertex " + std::to_string(cloud.points.size()) +
                        "\nproperty double x\nproperty double y\nproperty double z\n";
    if (coloured) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    bytes += "end_header\n";
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        char raw[3 * sizeof(double)];
        std::memcpy(raw, cloud.points[i].data(), sizeof raw);
        bytes.append(raw, sizeof raw);
        if (coloured)
            for (const std::uint8_t c : cloud.colours[i]) bytes += static_cast<char>(c);
    }
    return bytes;
}

[[noreturn]] void failed(const fs::path& path, int error) {
    throw IoError("io.write", path.string(), "",
                  "cannot be written: " + std::generic_category().message(error),
                  "check the folder, its permissions and the free space");
}

/// Whoever looks at `path` sees the old file or the whole new one.
void write_atomically(const fs::path& path, const std::string& bytes) {
    fs::path part = path;
    part += ".part" + std::to_string(::getpid());
    std::FILE* const file = std::fopen(part.c_str(), "wb");
    if (!file) failed(path, errno);
    int error = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() ? 0 : errno;
    if (std::fclose(file) != 0 && error == 0) error = errno;
    std::error_code renamed;
    if (error == 0) {
        fs::rename(part, path, renamed);
        error = renamed.value();
    }
    if (error != 0) {
        std::error_code ignored;
        fs::remove(part, ignored);
        failed(path, error);
    }
}

}  // namespace

void write_cloud(const fs::path& path, const Cloud& cloud) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool coloured = !cloud.points.empty() && cloud.colours.size() == cloud.points.size();
    if (extension == ".obj")
        write_atomically(path, obj_text(cloud, coloured));
    else if (extension == ".xyz")
        write_atomically(path, xyz_text(cloud, coloured));
    else if (extension == ".ply")
        write_atomically(path, ply_bytes(cloud, coloured));
    else
        throw IoError("io.format", path.string(), "",
                      extension.empty() ? "the file's name has no extension"
                                        : "clouds are not written as " + in_quotes(extension),
                      "accepted are .xyz .obj .ply");
}

}  // namespace dsc::cloud
