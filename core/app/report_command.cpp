// dsc report
#include <memory>
#include <thread>

#include <dsc/base/error.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/io/atomic_file.hpp>
#include <dsc/report/report.hpp>
#include <dsc/sweep/results.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "plugins.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
    std::vector<std::string> folders;
    std::string output;
    std::vector<std::string> plugins;
};

fs::path output_of(const ReportArguments& arguments) {
    if (!arguments.output.empty()) return arguments.output;
    return arguments.folders.size() == 1 ? fs::path(arguments.folders.front()) / "report.html"
                                         : fs::path("comparison.html");
}

/// The runs, and what is known of those that belong to a sweep.
std::vector<report::ComparedRun> compared_runs(const std::vector<fs::path>& folders,
                                               Workers& workers) {
    std::vector<report::ComparedRun> runs;
    const auto points = sweep::points_of_runs(folders, &workers);
    for (std::size_t i = 0; i < folders.size(); ++i) {
        report::ComparedRun& run = runs.emplace_back(report::ComparedRun{folders[i]});
        if (!points[i]) continue;
        run.index = points[i]->index;
        run.truth = points[i]->truth;
        for (const config::ConfigEntry& entry : points[i]->overrides.entries()) {
            run.overrides.emplace_back(entry.key, entry.value.is_string()
                                                      ? entry.value.as_string()
                                                      : config::flow_text(entry.value));
        }
    }
    return runs;
}

int execute(const ReportArguments& arguments) {
    const std::vector<fs::path> folders(arguments.folders.begin(), arguments.folders.end());
    const fs::path output = output_of(arguments);
    if (!arguments.output.empty()) require_output(output, "");
    Workers workers(std::max(1U, std::thread::hardware_concurrency()));
    // The plugins provide the filters of the cloud. Without them the page is still written, and it
    // states what is missing.
    Plugins plugins(arguments.plugins);
    const host::Host& host = plugins.load_what_works(report::plugins_of_runs(folders));
    const std::string page =
        folders.size() == 1
            ? report::report_html(folders.front(), host, &workers)
            : report::comparison_html(compared_runs(folders, workers), host, &workers);
    io::write_file(output, page);
    data_out() << output.string() << "\n";
    return 0;
}

}  // namespace

void add_report(CLI::App& app, Context& context) {
    CLI::App* command =
        app.add_subcommand("report", "Write a page that shows one run or compares several runs");
    const auto arguments = std::make_shared<ReportArguments>();
    command->add_option("DIR", arguments->folders, "Folders of finished runs")->required();
    command
        ->add_option("-o,--output", arguments->output,
                     "Page to write; default: DIR/report.html for one run, comparison.html in the "
                     "current folder for several runs")
        ->expected(1);
    add_plugins(*command, arguments->plugins);
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
