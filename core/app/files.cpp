#include "files.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/base/replace_file.hpp>
#include <dsc/cloud/read.hpp>
#include <dsc/io/formats.hpp>
#include <dsc/io/read.hpp>
#include <dsc/run/run_folder.hpp>
#include <dsc/surface/surface_view.hpp>
#include <dsc/text/words.hpp>

namespace dsc::app {

namespace fs = std::filesystem;

Content read_any(const fs::path& file, const std::vector<std::string>& columns) {
    const auto read_cloud = [&] {
        Content content;
        cloud::ReadReport report;
        content.cloud = cloud::read_cloud(file, &report, {columns});
        content.dropped = report.dropped_non_finite;
        content.properties = std::move(report.properties);
        return content;
    };
    const io::Format* format = io::find_format(file);
    if (format == nullptr || !columns.empty()) return read_cloud();
    Content content;
    if (format->volume) {
        content.volume = io::read_volume(file);
        return content;
    }
    try {
        content.surface = io::read_surface(file);
        return content;
    } catch (const IoError& error) {
        const std::string extension = text::lower_case_extension(file);
        if (error.code() != "io.no_faces" || (extension != ".obj" && extension != ".ply")) throw;
    }
    return read_cloud();
}

void add_columns(CLI::App& command, std::vector<std::string>& columns) {
    command
        .add_option("--columns", columns,
                    "Columns of a text cloud: X,Y,Z or X,Y,Z,RED,GREEN,BLUE, given by their names "
                    "in the header or by their numbers from 1")
        ->delimiter(',')
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

surface::TriangleMesh read_any_surface(const fs::path& path) {
    if (fs::is_directory(path)) {
        const fs::path result = run::result_surface(path);
        if (!result.empty()) return io::read_surface(result);
        throw IoError("io.no_result", path.string(), "",
                      "is a folder that does not contain result/surface.*",
                      "name a file or the folder of a finished run");
    }
    Content content = read_any(path);
    if (content.volume) return surface::extract_interface(*content.volume);
    if (content.cloud) {
        throw UsageError("file.no_surface", path.string(), "contains points without faces",
                         "give a surface or a volume");
    }
    return std::move(*content.surface);
}

bool is_utf8(const std::string& text) {
    try {
        static_cast<void>(nlohmann::json(text).dump());
        return true;
    } catch (const nlohmann::json::type_error&) {
        return false;
    }
}

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::exists(a, error) && fs::exists(b, error)) return fs::equivalent(a, b, error);
    return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

void require_output(const fs::path& out, const fs::path& input) {
    if (same_file(out, input)) {
        throw UsageError("file.same", out.string(), "is the input", "give another file with -o");
    }
    const fs::path folder = out.has_parent_path() ? out.parent_path() : fs::path(".");
    if (!fs::is_directory(folder)) {
        throw IoError("io.folder", out.string(), "",
                      fmt::format("its folder {} does not exist", folder.string()),
                      "create the folder first");
    }
    if (fs::is_directory(out)) {
        throw UsageError("file.folder", out.string(), "is a folder", "give a file with -o");
    }
    require_replaceable(out);
}

}  // namespace dsc::app
