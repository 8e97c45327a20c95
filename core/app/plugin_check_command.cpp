// dsc plugin check FILE|ID
#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/conformance/check.hpp>
#include <dsc/io/atomic_file.hpp>
#include <memory>

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

/// A strategy's id: which library has it, and its kind.
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
            throw UsageError("usage.strategy",
                             "two kinds have a strategy '" + arguments.target + "'; add --kind");
        file = info.plugin->file;
        strategies.push_back({info.strategy->kind, info.strategy->id});
    }
    if (!file.empty()) return file;
    const auto near = config::closest(arguments.target, ids);
    throw UsageError("usage.strategy", "there is neither a file nor a strategy '" + arguments.target + "'" +
                                           (near ? "; did you mean '" + *near + "'?" : "") +
                                           "; dsc plugin list shows all strategies");
}

std::string formatted(const conformance::Report& report, const std::string& format) {
    if (format == "json") return conformance::json(report);
    if (format == "junit") return conformance::junit(report);
    return conformance::text(report);
}

int execute(const CheckArguments& arguments) {
    if (arguments.list) return list_tests();
    if (arguments.target.empty()) throw UsageError("usage.check", "name a plugin's file or a strategy's id");
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
    CLI::App* command = plugin.add_subcommand("check", "Whether a plugin keeps what a plugin promises");
    const auto arguments = std::make_shared<CheckArguments>();
    command->add_option("FILE|ID", arguments->target,
                        "A library, or a strategy that is found on the search path");
    command->add_option("--kind", arguments->kind, "The strategy's kind, where two kinds have the id");
    command->add_option("--level", arguments->level, "smoke, standard or strict")
        ->check(CLI::IsMember({"smoke", "standard", "strict"}))
        ->capture_default_str();
    command->add_option("--only", arguments->only, "Only this test; may repeat");
    command->add_option("--plugin", arguments->plugins, "Plugin library or folder of them; may repeat")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option(
        "--notes", arguments->notes,
        "Parameters without a default and tests waived with a reason; default libdsc_NAME.check.yaml beside");
    command->add_option("--format", arguments->format, "text, json or junit")
        ->check(CLI::IsMember({"text", "json", "junit"}))
        ->capture_default_str();
    command->add_option("-o,--output", arguments->output, "File for the report instead of stdout");
    command
        ->add_option("--seed", arguments->seed,
                     "Of all that is random in the tests; the same seed is the same check")
        ->capture_default_str();
    command->add_option("--fuzz", arguments->fuzz, "Random parameter sets a strategy")->capture_default_str();
    command
        ->add_option("--timeout", arguments->limit,
                     "Seconds a test may take; ten times as much under a sanitizer")
        ->check(CLI::Range(0.1, 1e5))
        ->capture_default_str();
    command->add_flag("--in-process", arguments->in_process, "No process of its own a test, for a debugger");
    command->add_flag("--list", arguments->list, "Only list the tests");
    command->callback(
        [arguments, &context] { context.action = [arguments] { return execute(*arguments); }; });
}

}  // namespace dsc::app
