// dsc plugin new NAME --kind KIND
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/host/search_path.hpp>

#include "commands.hpp"
#include "plugin_project.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

namespace fs = std::filesystem;

struct NewArguments {
    std::string name;
    std::string kind;
};

plugin::Kind kind_of_word(const std::string& word) {
    if (const auto kind = plugin::find_kind(word)) return *kind;
    std::vector<std::string> names;
    for (const plugin::Kind kind : plugin::all_kinds) names.emplace_back(plugin::kind_name(kind));
    throw UsageError(
        "usage.kind", "--kind", fmt::format("there is no kind of strategy '{}'", word),
        fmt::format("{}the kinds are {}", config::did_you_mean(word, names), config::join(names)));
}

/// dsc would use a library of the same name in the user's folder instead of its own one, and ignore
/// the strategies of the latter.
void require_free_name(const std::string& name) {
    std::error_code error;
    const fs::path built_in = host::installed_folder() / ("libdsc_" + name + ".so");
    if (fs::exists(built_in, error)) {
        throw UsageError("usage.plugin_taken", "dsc plugin new",
                         fmt::format("'{}' is the name of a plugin that comes with dsc ({})", name,
                                     built_in.string()),
                         "choose another name");
    }
    if (fs::symlink_status(name, error).type() != fs::file_type::not_found) {
        throw UsageError("usage.exists", name, "already exists here",
                         "use another name or another folder");
    }
}

/// Prints the next commands on stderr, as they must be typed here.
void log_next(const std::string& name) {
    const fs::path package = (host::installed_folder() / "../../cmake/dsc").lexically_normal();
    std::error_code error;
    if (!fs::exists(package / "dscConfig.cmake", error)) {
        log(LogLevel::warning,
            fmt::format("this dsc is not installed, but {} needs an installed dsc: run cmake "
                        "--install BUILD_FOLDER --prefix PREFIX, then use PREFIX/bin/dsc",
                        name));
        return;
    }
    log(LogLevel::info,
        fmt::format("next: cmake -S {0} -B {0}/build -Ddsc_DIR='{1}'", name, package.string()));
    log(LogLevel::info, fmt::format("then: cmake --build {0}/build && ctest --test-dir {0}/build "
                                    "&& dsc run {0}/experiment.yaml",
                                    name));
}

int execute(const NewArguments& arguments) {
    require_plugin_name(arguments.name);
    const plugin::Kind kind = kind_of_word(arguments.kind);
    require_free_name(arguments.name);
    const std::vector<ProjectFile> files = plugin_project(arguments.name, kind);
    write_project(fs::path(".") / arguments.name, files);
    for (const ProjectFile& file : files) data_out() << arguments.name << "/" << file.name << "\n";
    log_next(arguments.name);
    return 0;
}

}  // namespace

void add_plugin_new(CLI::App& plugin, Context& context) {
    CLI::App* command =
        plugin.add_subcommand("new", "Create the new folder NAME with a project for your own "
                                     "strategy: code, test, experiment, page");
    const auto arguments = std::make_shared<NewArguments>();
    command
        ->add_option("NAME", arguments->name,
                     "Name of lower case letters, digits and _; the library becomes libdsc_NAME.so")
        ->required();
    command
        ->add_option(
            "--kind", arguments->kind,
            "Kind: velocity, curvature, refinement, initial_mesh, improvement, observer or filter")
        ->required();
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
