// dsc sweep expand | collect
#include <memory>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/sweep/sweep.hpp>
#include <dsc/text/words.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "plugins.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

namespace fs = std::filesystem;

struct ExpandArguments {
    std::string file;
    std::string folder;
    std::vector<std::string> plugins;
    bool check = false;
};

struct CollectArguments {
    std::string folder;
    std::string output;
};

int expand(const ExpandArguments& arguments) {
    if (arguments.folder.empty() && !arguments.check)
        throw UsageError("usage.output", "dsc sweep expand",
                         "-o DIR, the folder for the points, is missing",
                         "add it, or use --check to write nothing");
    const sweep::Sweep sweep = sweep::load_sweep(arguments.file);
    if (sweep.repeated > 0)
        log(LogLevel::warning, fmt::format("{}: {} left out because they equal earlier points",
                                           arguments.file, text::counted(sweep.repeated, "point")));
    Plugins plugins(arguments.plugins);
    const std::vector<std::string> experiments =
        sweep::sweep_experiments(sweep, plugins.loader(), plugins.host());
    if (arguments.check) {
        data_out() << arguments.file << ": valid, " << text::counted(sweep.points.size(), "point")
                   << "\n";
        return 0;
    }
    const sweep::Expansion done = sweep::expand_sweep(sweep, experiments, arguments.folder);
    std::string text = fmt::format(
        "{}: {} new, {} kept", text::counted(sweep.points.size(), "point"), done.added, done.kept);
    if (done.others > 0) {
        text += fmt::format(
            "; the table also contains {} points that are not in the sweep any more", done.others);
    }
    log(LogLevel::info, text);
    data_out() << (fs::path(arguments.folder) / "jobs.tsv").string() << "\n";
    return 0;
}

int collect(const CollectArguments& arguments) {
    if (!arguments.output.empty()) require_output(arguments.output, arguments.folder);
    sweep::SweepStates states;
    const std::string table = sweep::collect_sweep(arguments.folder, states);
    log(LogLevel::info, fmt::format("{}: {} done, {} failed, {} unfinished, {} not started",
                                    text::counted(states.points, "point"), states.done,
                                    states.failed, states.unfinished, states.missing));
    if (arguments.output.empty()) {
        data_out() << table;
    } else {
        io::write_file(arguments.output, table);
        data_out() << arguments.output << "\n";
    }
    return 0;
}

void add_expand(CLI::App& sweep, Context& context) {
    CLI::App* command =
        sweep.add_subcommand("expand", "Write a folder for each point of a sweep, and a job table");
    const auto arguments = std::make_shared<ExpandArguments>();
    command->add_option("SWEEP", arguments->file, "Sweep, a YAML file")->required();
    command->add_option("-o,--output", arguments->folder,
                        "Folder for the points; points that it already contains are kept");
    add_plugins(*command, arguments->plugins);
    command->add_flag("--check", arguments->check, "Check all points and write nothing");
    set_action(*command, context, [arguments] { return expand(*arguments); });
}

void add_collect(CLI::App& sweep, Context& context) {
    CLI::App* command = sweep.add_subcommand(
        "collect", "Collect one CSV table: status, overrides and main figures of every point");
    const auto arguments = std::make_shared<CollectArguments>();
    command->add_option("DIR", arguments->folder, "Folder that dsc sweep expand wrote")->required();
    command->add_option("-o,--output", arguments->output, "File for the table; default: stdout");
    set_action(*command, context, [arguments] { return collect(*arguments); });
}

}  // namespace

void add_sweep(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand(
        "sweep", "Expand a parameter sweep into run folders; collect their results into a "
                 "table");
    command->require_subcommand(1);
    add_expand(*command, context);
    add_collect(*command, context);
}

}  // namespace dsc::app
