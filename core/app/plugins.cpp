#include "plugins.hpp"

#include "load_guard.hpp"

namespace dsc::app {

void add_plugins(CLI::App& command, std::vector<std::string>& plugins) {
    command
        .add_option("--plugin", plugins,
                    "Plugin library, folder of libraries, or Python file; may be repeated")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

Plugins::Plugins(std::vector<std::string> command_line) : command_line_(std::move(command_line)) {}

std::vector<host::SearchEntry> Plugins::search_path(
    const std::vector<std::string>& experiment) const {
    host::SearchOptions options;
    options.command_line.assign(command_line_.begin(), command_line_.end());
    options.experiment.assign(experiment.begin(), experiment.end());
    return host::search_path(options);
}

const host::Host& Plugins::load(const std::vector<std::string>& experiment) {
    const LoadGuard guard;
    host_.load_all(search_path(experiment));
    return host_;
}

const host::Host& Plugins::load_what_works(const std::vector<std::string>& experiment) {
    const LoadGuard guard;
    host_.load_all(search_path(experiment), host::OnFault::collect);
    return host_;
}

run::PluginLoader Plugins::loader() {
    return [this](const std::vector<std::string>& experiment) -> const config::StrategyLookup& {
        return load(experiment);
    };
}

std::vector<Described> all_strategies(const host::Host& host) {
    std::vector<Described> all;
    for (const plugin::StrategyInfo& info : host.list()) {
        all.push_back({std::string(plugin::kind_name(info.strategy->kind)), info.strategy->id,
                       info.strategy->summary, info.plugin->name, info.plugin->version,
                       info.plugin->file.string(), info.strategy->schema.get()});
    }
    return all;
}

}  // namespace dsc::app
