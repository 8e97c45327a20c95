#pragma once
// Connects the plugin host and the run module.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <dsc/host/host.hpp>
#include <dsc/run/experiment.hpp>

#include "describe.hpp"

namespace dsc::app {

/// Adds the option --plugin to a command that uses strategies.
void add_plugins(CLI::App& command, std::vector<std::string>& plugins);

/// Owns the host of a command.
class Plugins {
public:
    /// `command_line`: the arguments of --plugin.
    explicit Plugins(std::vector<std::string> command_line);

    /// Loads everything on the search path and the plugins that an experiment names. Throws
    /// PluginError.
    const host::Host& load(const std::vector<std::string>& experiment = {});
    /// The same, but refused libraries are collected (Host::faults) and do not stop the loading.
    const host::Host& load_what_works(const std::vector<std::string>& experiment = {});
    /// load() in the form that run::load_experiment needs; this object must outlive it.
    run::PluginLoader loader();
    const host::Host& host() const { return host_; }
    std::vector<host::SearchEntry> search_path(
        const std::vector<std::string>& experiment = {}) const;

private:
    std::vector<std::string> command_line_;
    host::Host host_;
};

/// All strategies of a host; valid as long as the host.
std::vector<Described> all_strategies(const host::Host& host);

}  // namespace dsc::app
