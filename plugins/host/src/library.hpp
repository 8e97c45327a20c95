#pragma once
// Opens a library that has passed the gate and collects the strategies that it registers; here its
// code runs.

#include <filesystem>
#include <vector>

#include <dsc/plugin/entry.hpp>
#include <dsc/plugin/registrar.hpp>

namespace dsc::host {

/// Opens it with RTLD_NOW and RTLD_LOCAL and never closes it: virtual tables, exceptions and
/// statics of a plugin stay valid. Throws PluginError "plugin.load", "plugin.no_entry".
const plugin::PluginEntry& open_library(const std::filesystem::path& file);

/// The strategies that the plugin registers, all or none. Throws PluginError "plugin.enroll".
std::vector<plugin::StrategyRecord> enroll(const plugin::PluginEntry& entry,
                                           const std::filesystem::path& file);

}  // namespace dsc::host
