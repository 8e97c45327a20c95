// dsc report
#include <memory>
#include <thread>

#include <dsc/io/atomic_file.hpp>
#include <dsc/report/report.hpp>

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

int execute(const ReportArguments& arguments) {
    const std::vector<fs::path> folders(arguments.folders.begin(), arguments.folders.end());
    const fs::path output = output_of(arguments);
    if (!arguments.output.empty()) require_output(output, "");
    Workers workers(std::max(1U, std::thread::hardware_concurrency()));
    // The plugins provide the filters of the cloud. Without them the page is still written, and it
    // states what is missing.
    Plugins plugins(arguments.plugins);
    const host::Host& host = plugins.load_what_works(report::plugins_of_runs(folders));
    const std::string page = folders.size() == 1
                                 ? report::report_html(folders.front(), host, &workers)
                                 : report::comparison_html(folders, host, &workers);
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
                     "Page to write; default: DIR/report.html, for several runs comparison.html in "
                     "the current folder")
        ->expected(1);
    add_plugins(*command, arguments->plugins);
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
