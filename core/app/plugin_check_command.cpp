// dsc plugin check FILE|ID
#include <memory>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/conformance/check.hpp>
#include <dsc/io/atomic_file.hpp>

#include "commands.hpp"
#include "files.hpp"
#include "plugins.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

struct CheckArguments {
    std::string target;
    std::string kind;
    std::string level = "standard";
    std::vector<std::string> only;
    std::vector<std::string> plugins;
    std::string notes;
    std::string format = "text";
    std::string output;
    std::uint64_t seed = 1;
    unsigned fuzz = 20;
    double limit = 30;
    bool in_process = false;
    bool list = false;
};

int list_tests() {
    for (const conformance::TestInfo& test : conformance::tests()) {
        std::string row = test.id;
        row.resize(18, ' ');
        row += conformance::name(test.level);
        row.resize(28, ' ');
        data_out() << row << test.doc << "\n";
    }
    return 0;
}

/// Finds the library and the kind of a strategy id.
std::filesystem::path find_strategy(const CheckArguments& arguments, const host::Host& host,
                                    std::vector<conformance::StrategyName>& strategies) {
    std::vector<std::string> ids;
    std::filesystem::path file;
    for (const plugin::StrategyInfo& info : host.list()) {
        ids.push_back(info.strategy->id);
        const bool wanted =
            info.strategy->id == arguments.target &&
            (arguments.kind.empty() || plugin::kind_name(info.strategy->kind) == arguments.kind);
        if (!wanted) continue;
        if (!file.empty() && file != info.plugin->file)
            throw UsageError("usage.strategy", "dsc plugin check",
                             fmt::format("several kinds have a strategy '{}'", arguments.target),
                             "choose one with --kind");
        file = info.plugin->file;
        strategies.push_back({info.strategy->kind, info.strategy->id});
    }
    if (!file.empty()) return file;
    throw UsageError(
        "usage.strategy", "dsc plugin check",
        fmt::format("'{}' is neither a file nor the name of a strategy", arguments.target),
        config::did_you_mean(arguments.target, ids) + "dsc plugin list shows all strategies");
}

std::string formatted(const conformance::Report& report, const std::string& format) {
    if (format == "json") return conformance::json(report);
    if (format == "junit") return conformance::junit(report);
    return conformance::text(report);
}

int execute(const CheckArguments& arguments) {
    if (arguments.list) return list_tests();
    if (arguments.target.empty())
        throw UsageError("usage.check", "dsc plugin check",
                         "a plugin file or a strategy id is missing", "give one of them");
    if (!arguments.output.empty()) require_output(arguments.output, arguments.target);
    conformance::CheckOptions options;
    options.level = conformance::find_level(arguments.level).value();
    options.seed = arguments.seed;
    options.fuzz = arguments.fuzz;
    options.limit = std::chrono::milliseconds(static_cast<std::int64_t>(arguments.limit * 1000));
    options.only = arguments.only;
    options.notes = arguments.notes;
    options.in_process = arguments.in_process;
    Plugins plugins(arguments.plugins);
    options.search = plugins.search_path();
    std::filesystem::path file = arguments.target;
    if (!std::filesystem::exists(file))
        file = find_strategy(arguments, plugins.load_what_works(), options.strategies);
    const bool live = arguments.output.empty() && arguments.format == "text";
    if (live)
        options.on_outcome = [](const conformance::Outcome& o) {
            data_out() << conformance::text(o) << std::flush;
        };
    const conformance::Report report = conformance::check(file, options);
    if (!arguments.output.empty()) {
        io::write_file(arguments.output, formatted(report, arguments.format));
    } else if (live) {
        data_out() << conformance::sums(report);
    } else {
        data_out() << formatted(report, arguments.format);
    }
    return report.passed() ? 0 : static_cast<int>(ExitCode::plugin);
}

}  // namespace

void add_plugin_check(CLI::App& plugin, Context& context) {
    CLI::App* command = plugin.add_subcommand("check", "Run the conformance tests on a plugin");
    const auto arguments = std::make_shared<CheckArguments>();
    command->add_option("FILE|ID", arguments->target,
                        "Plugin library, Python file, or the id of a strategy on the search path");
    command->add_option("--kind", arguments->kind,
                        "Kind of the strategy, needed if two kinds have the same id");
    command
        ->add_option("--level", arguments->level, "Level of the tests: smoke, standard or strict")
        ->check(CLI::IsMember({"smoke", "standard", "strict"}))
        ->capture_default_str();
    command->add_option("--only", arguments->only, "Run only this test; may be repeated");
    add_plugins(*command, arguments->plugins);
    command->add_option("--notes", arguments->notes,
                        "File with values of parameters that have no default, and with tests that "
                        "need not hold; default: libdsc_NAME.check.yaml beside the plugin");
    command->add_option("--format", arguments->format, "Format of the report: text, json or junit")
        ->check(CLI::IsMember({"text", "json", "junit"}))
        ->capture_default_str();
    command->add_option("-o,--output", arguments->output, "File for the report; default: stdout");
    command
        ->add_option("--seed", arguments->seed,
                     "Random seed; the same seed repeats the same checks")
        ->capture_default_str();
    command->add_option("--fuzz", arguments->fuzz, "Number of random parameter sets per strategy")
        ->capture_default_str();
    command
        ->add_option("--timeout", arguments->limit,
                     "Time limit per test in seconds; with a sanitizer it is ten times as long")
        ->check(CLI::Range(0.1, 1e5))
        ->capture_default_str();
    command->add_flag("--in-process", arguments->in_process,
                      "Run all tests in this process (for debugging)");
    command->add_flag("--list", arguments->list, "List the tests and run none");
    set_action(*command, context, [arguments] { return execute(*arguments); });
}

}  // namespace dsc::app
