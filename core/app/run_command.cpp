// dsc run
#include <memory>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/report/report.hpp>
#include <dsc/run/run_experiment.hpp>
#include <dsc/text/words.hpp>

#include "commands.hpp"
#include "crash_guard.hpp"
#include "duration.hpp"
#include "exit_guard.hpp"
#include "outcome.hpp"
#include "plugins.hpp"
#include "progress.hpp"
#include "standard_streams.hpp"
#include "threads.hpp"

namespace dsc::app {
namespace {

struct RunArguments {
    std::string config;
    std::vector<std::string> overrides;
    std::string folder;
    unsigned threads = 0;
    std::vector<std::string> plugins;
    bool check = false;
    bool resume = false;
    bool print_config = false;
    std::string time_budget;
    TerminalOptions terminal;
};

int check(const run::LoadedExperiment& loaded, const host::Host& host,
          const RunArguments& arguments) {
    run::make_strategies(loaded.experiment, host);
    const std::filesystem::path folder = arguments.folder.empty()
                                             ? run::default_folder(loaded, host)
                                             : std::filesystem::path(arguments.folder);
    if (arguments.print_config) return 0;
    data_out() << arguments.config << ": valid, "
               << text::counted(run::planned_steps(loaded.experiment), "step")
               << "; the run folder is " << folder.string() << "\n";
    return 0;
}

int execute(const RunArguments& arguments, const std::vector<std::string>& command) {
    start_log(arguments.terminal);
    const std::optional<double> budget = arguments.time_budget.empty()
                                             ? std::nullopt
                                             : std::optional(parse_duration(arguments.time_budget));
    Plugins plugins(arguments.plugins);
    const run::LoadedExperiment loaded =
        run::load_experiment(arguments.config, arguments.overrides, plugins.loader());
    guard_exit();
    guard_crashes(plugins.host().plugins());
    if (!loaded.warnings.empty()) log(LogLevel::warning, loaded.warnings);
    if (arguments.print_config) data_out() << run::resolved_text(loaded);
    if (arguments.check) return check(loaded, plugins.host(), arguments);
    if (arguments.print_config) return 0;

    const std::filesystem::path folder = arguments.folder.empty()
                                             ? run::default_folder(loaded, plugins.host())
                                             : std::filesystem::path(arguments.folder);
    if (arguments.resume && run::is_finished(folder, loaded, plugins.host())) {
        log(LogLevel::info,
            fmt::format("{} is finished; there is nothing to resume", folder.string()));
        data_out() << folder.string() << "\n";
        return 0;
    }
    run::RunOptions options;
    options.folder = folder;
    options.resume = arguments.resume;
    options.threads = thread_count(arguments.threads);
    options.time_budget = budget;
    options.cancel = &cancel_on_signals();
    options.command = command;
    options.on_step = progress_reporter(arguments.terminal, loaded.experiment);
    options.make_report = report::report_html;
    const run::RunOutcome outcome = run::run_experiment(loaded, plugins.host(), options);
    report(outcome);
    data_out() << outcome.folder.string() << "\n";
    return exit_code(outcome);
}

}  // namespace

void add_run(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand("run", "Run an experiment");
    const auto arguments = std::make_shared<RunArguments>();
    command->add_option("CONFIG", arguments->config, "Experiment, a YAML file")->required();
    command->add_option("KEY=VALUE", arguments->overrides,
                        "Values that replace those of the file, by dotted path");
    command->add_option("-o,--output", arguments->folder, "Run folder; default: runs/NAME/HASH");
    add_threads(*command, arguments->threads);
    add_plugins(*command, arguments->plugins);
    command->add_flag("--check", arguments->check, "Check the experiment and run nothing");
    command->add_flag("--print-config", arguments->print_config,
                      "Print the experiment with all defaults, and run nothing");
    command->add_flag(
        "--resume", arguments->resume,
        "Continue from the last checkpoint in the run folder, or from the start if there is none; "
        "a finished run is not changed, and the run of another experiment is refused");
    command->add_option(
        "--time-budget", arguments->time_budget,
        "Save a checkpoint and stop, with exit code 75, after this time: 90, 90s, 10m, 1.5h");
    add_progress(*command, arguments->terminal);
    add_verbosity(*command, arguments->terminal);
    set_action(*command, context,
               [arguments, &context] { return execute(*arguments, context.command_line); });
}

}  // namespace dsc::app
