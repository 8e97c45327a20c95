#include <dsc/cloud/read.hpp>

#include <algorithm>
#include <cctype>

#include <dsc/base/error.hpp>

#include "formats.hpp"
#include "text.hpp"

namespace dsc::cloud {

namespace {

constexpr std::string_view accepted = ".pcd .ply .obj .xyz .txt .asc .pts .csv";

std::string lower_extension(const std::filesystem::path& path) {
    std::string text = path.extension().string();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& extension) {
    const std::string file = path.string();
    const std::string stem = path.stem().string();
    if (extension == ".las" || extension == ".laz")
        throw IoError("io.format", file, "", extension.substr(1) + " files are not read here",
                      "convert it first: pdal translate " + path.filename().string() + " " + stem + ".ply");
    if (extension == ".e57")
        throw IoError("io.format", file, "", "e57 files are not read here",
                      "convert it first: pdal translate " + path.filename().string() + " " + stem +
                          ".ply, or save it as PLY with CloudCompare");
    throw IoError("io.format", file, "",
                  extension.empty() ? "the file's name has no extension"
                                    : in_quotes(extension) + " is no known cloud format",
                  "accepted are " + std::string(accepted));
}

}  // namespace

Cloud read_cloud(const std::filesystem::path& path, ReadReport* report) {
    const std::string extension = lower_extension(path);
    const bool pcd = extension == ".pcd";
    const bool ply = extension == ".ply";
    const bool obj = extension == ".obj";
    const bool xyz = extension == ".xyz" || extension == ".txt" || extension == ".asc" ||
                     extension == ".pts" || extension == ".csv";
    if (!pcd && !ply && !obj && !xyz) refuse(path, extension);

    const std::string file = path.string();
    ReadReport local;
    ReadReport& filled = report ? *report : local;
    filled = {};
    Cloud cloud;
    if (obj || xyz) {
        const std::string text = read_file(path);
        cloud = obj ? read_obj(file, text) : read_xyz(file, text);
        filled.points = cloud.points.size();
        filled.format = obj ? "OBJ" : "XYZ";
    } else {
        FileCheck check;
        {
            const std::string bytes = read_file(path);  // freed before PCL reads the file again
            check = pcd ? check_pcd(file, bytes) : check_ply(file, bytes);
        }
        filled.points = check.points;
        filled.format = pcd ? "PCD" : "PLY";
        cloud = pcd ? read_pcd(path, check, filled) : read_ply(path, check, filled);
    }
    cloud.source = file;
    return cloud;
}

}  // namespace dsc::cloud
