#pragma once
// Opens a library that has passed the gate, or runs a script, and collects the strategies that it
// registers; here its code runs.

#include <filesystem>
#include <string>
#include <vector>

#include <dsc/plugin/catalogue.hpp>
#include <dsc/plugin/entry.hpp>
#include <dsc/plugin/registrar.hpp>

namespace dsc::host {

/// The folder of the core library.
std::filesystem::path library_folder();

/// Why the last call of dlopen() or dlsym() failed.
std::string dl_reason();

/// Opens it with RTLD_NOW and RTLD_LOCAL and never closes it: virtual tables, exceptions and
/// statics of a plugin stay valid. Throws PluginError "plugin.load", "plugin.no_entry".
const plugin::PluginEntry& open_library(const std::filesystem::path& file);

/// The strategies that the plugin registers, all or none. Throws PluginError "plugin.enroll".
std::vector<plugin::StrategyRecord> enroll(const plugin::PluginEntry& entry,
                                           const std::filesystem::path& file);

/// A script and its strategies.
struct Script {
    plugin::PluginInfo info;
    std::vector<plugin::StrategyRecord> strategies;
};

/// Runs a script and collects the strategies that it registers, all or none. If this process has no
/// loader of scripts yet, it starts the one in the library `library`, which looks for its modules
/// in the folder `modules`. Throws PluginError "plugin.no_python", "plugin.script",
/// "plugin.enroll".
Script run_script(const std::filesystem::path& file, const std::filesystem::path& library,
                  const std::filesystem::path& modules);

}  // namespace dsc::host
