// Reads point clouds: chooses the format and checks the columns.
#include "dsc/cloud/read.hpp"

#include <vector>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/text/words.hpp>

#include "attributes.hpp"
#include "formats.hpp"
#include "pcl_backend.hpp"

namespace dsc::cloud {

namespace {

constexpr std::string_view readable = ".pcd .ply .obj .xyz .txt .asc .pts .csv";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& extension) {
    const std::string file = path.string();
    const std::string stem = path.stem().string();
    if (extension == ".las" || extension == ".laz")
        throw IoError(
            "io.format", file, "", extension.substr(1) + " files are not supported",
            "convert it first: pdal translate " + path.filename().string() + " " + stem + ".ply");
    if (extension == ".e57")
        throw IoError("io.format", file, "", "e57 files are not supported",
                      "convert it first: pdal translate " + path.filename().string() + " " + stem +
                          ".ply, or save it as PLY with CloudCompare");
    throw IoError("io.format", file, "",
                  extension.empty()
                      ? "the file's name has no extension"
                      : text::in_quotes(extension) + " is not a supported cloud format",
                  "accepted are " + std::string(readable));
}

bool is_table(const std::string& extension) {
    return extension == ".xyz" || extension == ".txt" || extension == ".asc" ||
           extension == ".pts" || extension == ".csv";
}

void require_columns(const std::string& file, bool table, const ReadOptions& options) {
    const std::size_t count = options.columns.size();
    if (count == 0) return;
    if (!table)
        throw IoError("io.columns", file, "", "columns can be chosen only for text clouds",
                      "remove the choice of columns, or convert the cloud to .csv");
    if (count != 3 && count != 6)
        throw IoError("io.columns", file, "",
                      text::counted(count, "column") + (count == 1 ? " is chosen" : " are chosen"),
                      "choose 3 (x, y, z) or 6 (x, y, z, red, green, blue)");
}

/// The extension, in lower case.
std::string require_cloud_file(const std::filesystem::path& path, const ReadOptions& options) {
    std::string extension = text::lower_case_extension(path);
    if (extension != ".pcd" && extension != ".ply" && extension != ".obj" && !is_table(extension))
        refuse(path, extension);
    require_columns(path.string(), is_table(extension), options);
    return extension;
}

void require_text(const std::string& file, std::string_view bytes) {
    if (bytes.empty())
        throw IoError("io.empty", file, "", "the file is empty", "write the cloud again");
    if (has_wide_byte_order_mark(bytes))
        throw IoError("io.format", file, "", wide_text_cause, wide_text_remedy);
}

}  // namespace

std::string_view cloud_extensions() { return readable; }

bool is_cloud_file(const std::filesystem::path& path) {
    const std::string extension = text::lower_case_extension(path);
    return extension == ".obj" || extension == ".ply" || extension == ".pcd" || is_table(extension);
}

Cloud parse_cloud(const std::filesystem::path& path, std::string bytes, ReadReport* report,
                  const ReadOptions& options) {
    const std::string extension = require_cloud_file(path, options);
    const std::string file = path.string();
    require_text(file, bytes);
    bytes.erase(0, bytes.size() - without_byte_order_mark(bytes).size());
    ReadReport local;
    ReadReport& filled = report ? *report : local;
    filled = {};
    std::vector<std::string> names;
    Cloud cloud;
    if (extension == ".pcd") {
        cloud = pcl_backend().read_pcd(file, std::move(bytes), filled, names);
    } else if (extension == ".ply") {
        cloud = pcl_backend().read_ply(file, std::move(bytes), filled, names);
    } else {
        const bool obj = extension == ".obj";
        filled.format = obj ? "OBJ" : extension == ".csv" ? "CSV" : "XYZ";
        cloud = obj ? read_obj(file, bytes, names) : read_table(file, bytes, options, names);
        filled.points = cloud.points.size();
    }
    filled.properties = found_properties(names, cloud);
    cloud.source = file;
    return cloud;
}

Cloud cloud_of(std::vector<Vec3> points, std::vector<Vec3> normals, std::vector<Colour> colours,
               std::string source) {
    Cloud cloud;
    cloud.points = std::move(points);
    cloud.normals = std::move(normals);
    for (Vec3& normal : cloud.normals) normal = direction_of(normal);
    keep_whole_normals(cloud);
    cloud.colours = std::move(colours);
    cloud.source = std::move(source);
    return cloud;
}

Cloud read_cloud(const std::filesystem::path& path, ReadReport* report,
                 const ReadOptions& options) {
    require_cloud_file(path, options);
    return parse_cloud(path, read_file(path), report, options);
}

}  // namespace dsc::cloud
