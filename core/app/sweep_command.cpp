// dsc sweep expand | collect | compare
#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/sweep/results.hpp>
#include <dsc/sweep/sweep.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "commands.hpp"
#include "figures_output.hpp"
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
    std::string groups;
};

struct CompareArguments {
    std::string folder;
    std::size_t first = 0;
    std::size_t second = 0;
    bool json = false;
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

sweep::SweepResults results_of(const std::string& folder) {
    Workers workers(std::max(1U, std::thread::hardware_concurrency()));
    return sweep::collect_sweep(folder, &workers);
}

int collect(const CollectArguments& arguments) {
    for (const std::string& output : {arguments.output, arguments.groups}) {
        if (!output.empty()) require_output(output, arguments.folder);
    }
    const sweep::SweepResults results = results_of(arguments.folder);
    const sweep::SweepStates& states = results.states;
    log(LogLevel::info, fmt::format("{}: {} done, {} failed, {} unfinished, {} not started",
                                    text::counted(states.points, "point"), states.done,
                                    states.failed, states.unfinished, states.missing));
    if (arguments.output.empty()) {
        if (arguments.groups.empty()) data_out() << sweep::results_csv(results);
    } else {
        io::write_file(arguments.output, sweep::results_csv(results));
        data_out() << arguments.output << "\n";
    }
    if (!arguments.groups.empty()) {
        io::write_file(arguments.groups, sweep::groups_csv(results));
        data_out() << arguments.groups << "\n";
    }
    return 0;
}

nlohmann::ordered_json sample_json(const statistics::Sample& sample) {
    return {{"n", sample.n},
            {"mean", sample.mean},
            {"deviation", sample.deviation},
            {"low", sample.low},
            {"high", sample.high}};
}

nlohmann::ordered_json comparison_json(const sweep::SettingsComparison& comparison) {
    nlohmann::ordered_json json = {{"first", comparison.first},
                                   {"second", comparison.second},
                                   {"pairs", comparison.pairs},
                                   {"figures", nlohmann::ordered_json::object()}};
    for (const auto& [name, found] : comparison.figures) {
        json["figures"][name] = {{"first", sample_json(found.first)},
                                 {"second", sample_json(found.second)},
                                 {"difference", sample_json(found.difference)},
                                 {"wilcoxon",
                                  {{"n", found.ranks.n},
                                   {"statistic", found.ranks.statistic},
                                   {"p", found.ranks.probability},
                                   {"exact", found.ranks.exact}}},
                                 {"signs",
                                  {{"positive", found.signs.positive},
                                   {"negative", found.signs.negative},
                                   {"zero", found.signs.zero},
                                   {"p", found.signs.probability}}}};
    }
    return json;
}

void print_comparison(const sweep::SettingsComparison& comparison) {
    data_out() << "first   " << comparison.first << "\nsecond  " << comparison.second << "\n"
               << text::counted(comparison.pairs, "pair") << " with the same seed and cloud\n\n";
    constexpr auto row = "{:<28} {:>11} {:>11} {:>11} {:>25} {:>8} {:>10} {:>8}\n";
    data_out() << fmt::format(row, "figure", "first", "second", "difference", "95 % interval",
                              "Wilcoxon", "+ / - / 0", "signs");
    const auto number = [](double value) {
        return std::isfinite(value) ? text::rounded(value, 4) : "-";
    };
    for (const auto& [name, found] : comparison.figures) {
        const statistics::Signs& signs = found.signs;
        data_out() << fmt::format(
            row, name, number(found.first.mean), number(found.second.mean),
            number(found.difference.mean),
            number(found.difference.low) + " to " + number(found.difference.high),
            number(found.ranks.probability),
            fmt::format("{} / {} / {}", signs.positive, signs.negative, signs.zero),
            number(signs.probability));
    }
    data_out() << "\nDifference: second - first; its interval is that of the paired t test. "
                  "Wilcoxon and signs: two-sided\nprobabilities of such differences without an "
                  "effect.\n";
}

int compare(const CompareArguments& arguments) {
    const sweep::SettingsComparison comparison =
        sweep::compare_settings(results_of(arguments.folder), arguments.first, arguments.second);
    if (arguments.json) {
        print_figures(comparison_json(comparison), true);
    } else {
        print_comparison(comparison);
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
    command->add_option("--groups", arguments->groups,
                        "File for a second table: n, mean, standard deviation and 95 % confidence "
                        "interval of the points that differ only in their seeds");
    set_action(*command, context, [arguments] { return collect(*arguments); });
}

void add_compare(CLI::App& sweep, Context& context) {
    CLI::App* command = sweep.add_subcommand(
        "compare", "Compare two settings of a sweep by their runs with the same seeds and clouds");
    const auto arguments = std::make_shared<CompareArguments>();
    command->add_option("DIR", arguments->folder, "Folder that dsc sweep expand wrote")->required();
    command
        ->add_option("FIRST", arguments->first,
                     "Number of a setting, as dsc sweep collect --groups lists it")
        ->required();
    command->add_option("SECOND", arguments->second, "Number of the other setting")->required();
    command->add_flag("--json", arguments->json, "Print JSON instead of text");
    set_action(*command, context, [arguments] { return compare(*arguments); });
}

}  // namespace

void add_sweep(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand(
        "sweep", "Expand a parameter sweep into run folders; collect and compare their results");
    command->require_subcommand(1);
    add_expand(*command, context);
    add_collect(*command, context);
    add_compare(*command, context);
}

}  // namespace dsc::app
