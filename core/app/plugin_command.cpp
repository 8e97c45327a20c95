// dsc plugin list | describe ID | path
#include <memory>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>

#include "commands.hpp"
#include "describe.hpp"
#include "plugins.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

using nlohmann::ordered_json;

struct PluginArguments {
    std::vector<std::string> plugins;
    bool json = false;
    std::string id;
    std::string kind;
    std::string format = "text";
};

/// Why a library is not among the plugins: the gate refused it, or it crashes or hangs when it is
/// loaded.
std::string_view state(const host::Fault& fault) {
    const std::string& code = fault.error.code();
    const bool broken = code == "plugin.crash" || code == "plugin.hang" ||
                        code == "plugin.enroll" || code == "plugin.load";
    return broken ? "broken" : "rejected";
}

void print_json(const std::vector<Described>& all, const std::vector<host::Fault>& faults) {
    ordered_json array = ordered_json::array();
    for (const Described& d : all) {
        array.push_back(summary_json(d));
        array.back()["state"] = "ok";
    }
    for (const host::Fault& fault : faults) {
        array.push_back({{"file", fault.file.string()},
                         {"state", std::string(state(fault))},
                         {"code", fault.error.code()},
                         {"reason", fault.error.what()}});
    }
    data_out() << array.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

int list(const PluginArguments& arguments) {
    Plugins plugins(arguments.plugins);
    const host::Host& host = plugins.load_what_works();
    const std::vector<Described> all = all_strategies(host);
    if (arguments.json) {
        print_json(all, host.faults());
    } else {
        data_out() << list_text(all);
        for (const host::Fault& fault : host.faults())
            data_out() << state(fault) << "  " << fault.error.what() << "\n";
    }
    return host.faults().empty() ? 0 : static_cast<int>(ExitCode::plugin);
}

std::string described(const Described& d, const std::string& format) {
    if (format == "yaml") return yaml_text(d);
    return format == "md" ? markdown_text(d) : description_text(d);
}

int describe(const PluginArguments& arguments) {
    Plugins plugins(arguments.plugins);
    const std::vector<Described> all = all_strategies(plugins.load());
    std::vector<Described> found;
    std::vector<std::string> ids;
    for (const Described& d : all) {
        if (!arguments.kind.empty() && d.kind != arguments.kind) continue;
        ids.push_back(d.id);
        if (d.id == arguments.id) found.push_back(d);
    }
    if (found.empty()) {
        throw UsageError(
            "usage.strategy", "dsc plugin describe",
            fmt::format("'{}' is not the name of a strategy{}{}", arguments.id,
                        arguments.kind.empty() ? "" : " of kind ", arguments.kind),
            config::did_you_mean(arguments.id, ids) + "dsc plugin list shows all strategies");
    }
    if (arguments.format == "json") {
        ordered_json array = ordered_json::array();
        for (const Described& d : found) array.push_back(full_json(d));
        data_out() << (array.size() == 1 ? array[0] : array)
                          .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                   << "\n";
        return 0;
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i > 0) data_out() << "\n";
        data_out() << described(found[i], arguments.format);
    }
    return 0;
}

int path(const PluginArguments& arguments) {
    for (const host::SearchEntry& entry : Plugins(arguments.plugins).search_path()) {
        data_out() << entry.path.string() << "  (" << entry.origin << ")\n";
    }
    return 0;
}

}  // namespace

void add_plugin(CLI::App& app, Context& context) {
    CLI::App* command = app.add_subcommand(
        "plugin", "List, describe, create and check plugins and their strategies");
    command->require_subcommand(1);
    const auto arguments = std::make_shared<PluginArguments>();
    const auto add = [&](const char* name, const char* text,
                         int (*action)(const PluginArguments&)) {
        CLI::App* sub = command->add_subcommand(name, text);
        add_plugins(*sub, arguments->plugins);
        sub->callback([arguments, action, &context] {
            context.action = [arguments, action] { return action(*arguments); };
        });
        return sub;
    };
    add("list", "List strategies, and libraries that failed to load", list)
        ->add_flag("--json", arguments->json, "Print JSON instead of text");
    CLI::App* describing = add("describe", "Describe the parameters of a strategy", describe);
    describing->add_option("ID", arguments->id, "Id of the strategy")->required();
    describing->add_option("--kind", arguments->kind,
                           "Kind of the strategy, needed if two kinds have the same id");
    describing
        ->add_option("--format", arguments->format,
                     "Format: text, json, yaml (a block for an experiment) or md (a page)")
        ->check(CLI::IsMember({"text", "json", "yaml", "md"}))
        ->capture_default_str();
    add("path", "Show where dsc looks for plugins, in order", path);
    add_plugin_new(*command, context);
    add_plugin_check(*command, context);
    add_plugin_doctor(*command, context);
}

}  // namespace dsc::app
