#include <dsc/cloud/read.hpp>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <vector>

#include <unistd.h>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>

#include "attributes.hpp"
#include "formats.hpp"
#include "text.hpp"

namespace dsc::cloud {

namespace {

constexpr std::string_view readable = ".pcd .ply .obj .xyz .txt .asc .pts .csv";

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
                  "accepted are " + std::string(readable));
}

bool is_table(const std::string& extension) {
    return extension == ".xyz" || extension == ".txt" || extension == ".asc" || extension == ".pts" ||
           extension == ".csv";
}

/// A file as PCL reads it rightly: without a byte order mark, and without the comments that PCL takes the number of points from.
class PlainCopy {
public:
    PlainCopy(const std::string& file, std::string_view bytes, const std::vector<std::size_t>& grid_comments) {
        std::error_code error;
        const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
        std::string pattern = ((error ? std::filesystem::path(".") : parent) / "dsc-XXXXXX").string();
        const int descriptor = ::mkstemp(pattern.data());
        if (descriptor < 0) fail_copy(file);
        path_ = pattern;
        std::string plain(bytes);
        for (const std::size_t at : grid_comments) plain.replace(at, comment.size(), comment);
        std::FILE* const stream = ::fdopen(descriptor, "wb");
        bool written = stream != nullptr && std::fwrite(plain.data(), 1, plain.size(), stream) == plain.size();
        if (stream == nullptr)
            ::close(descriptor);
        else
            written = std::fclose(stream) == 0 && written;
        if (written) return;
        std::filesystem::remove(path_, error);
        fail_copy(file);
    }
    ~PlainCopy() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    PlainCopy(const PlainCopy&) = delete;
    PlainCopy& operator=(const PlainCopy&) = delete;
    const std::filesystem::path& path() const { return path_; }

private:
    static constexpr std::string_view comment = "comment ";  // as long as "obj_info"

    [[noreturn]] static void fail_copy(const std::string& file) {
        throw IoError("io.temporary", file, "", "a copy without its byte order mark cannot be made in the folder for temporary files",
                      "set TMPDIR to a folder that can be written");
    }

    std::filesystem::path path_;
};

void require_columns(const std::string& file, bool table, const ReadOptions& options) {
    const std::size_t count = options.columns.size();
    if (count == 0) return;
    if (!table)
        throw IoError("io.columns", file, "", "columns can be chosen in text clouds only",
                      "leave the choice of columns out, or convert the cloud to .csv");
    if (count != 3 && count != 6)
        throw IoError("io.columns", file, "", counted(count, "column") + " chosen",
                      "choose 3 (x, y, z) or 6 (x, y, z, red, green, blue)");
}

Cloud read_pcd_file(const std::filesystem::path& path, ReadReport& report, std::vector<std::string>& names) {
    std::string bytes = read_file(path);
    bytes.erase(0, bytes.size() - without_byte_order_mark(bytes).size());
    const FileCheck check = check_pcd(path.string(), bytes);
    report.points = check.points;
    report.format = "PCD";
    names = check.names;
    return read_pcd(bytes, path.string(), check, report);
}

Cloud read_ply_file(const std::filesystem::path& path, ReadReport& report, std::vector<std::string>& names) {
    FileCheck check;
    std::optional<PlainCopy> copy;
    {
        const std::string bytes = read_file(path);  // freed before PCL reads the file again
        const std::string_view plain = without_byte_order_mark(bytes);
        check = check_ply(path.string(), plain);
        if (plain.size() != bytes.size() || !check.grid_comments.empty()) copy.emplace(path.string(), plain, check.grid_comments);
    }
    report.points = check.points;
    report.format = "PLY";
    names = check.names;
    return read_ply(copy ? copy->path() : path, path.string(), check, report);
}

}  // namespace

std::string_view cloud_extensions() { return readable; }

bool is_cloud_file(const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    return extension == ".obj" || extension == ".ply" || extension == ".pcd" || is_table(extension);
}

Cloud read_cloud(const std::filesystem::path& path, ReadReport* report, const ReadOptions& options) {
    const std::string extension = lower_extension(path);
    const bool pcd = extension == ".pcd";
    const bool ply = extension == ".ply";
    const bool obj = extension == ".obj";
    const bool table = is_table(extension);
    if (!pcd && !ply && !obj && !table) refuse(path, extension);

    const std::string file = path.string();
    require_columns(file, table, options);
    ReadReport local;
    ReadReport& filled = report ? *report : local;
    filled = {};
    std::vector<std::string> names;
    Cloud cloud;
    if (pcd) {
        cloud = read_pcd_file(path, filled, names);
    } else if (ply) {
        cloud = read_ply_file(path, filled, names);
    } else {
        const std::string bytes = read_file(path);
        const std::string_view text = without_byte_order_mark(bytes);
        filled.format = obj ? "OBJ" : extension == ".csv" ? "CSV" : "XYZ";
        cloud = obj ? read_obj(file, text, names) : read_table(file, text, options, names);
        filled.points = cloud.points.size();
    }
    filled.properties = found_properties(names, cloud);
    cloud.source = file;
    return cloud;
}

}  // namespace dsc::cloud
