#pragma once
// Opens a library that has passed the gate and collects what it registers: from here on its code runs.

#include <dsc/plugin/entry.hpp>
#include <dsc/plugin/registrar.hpp>
#include <filesystem>
#include <vector>

namespace dsc::host {

/// Opened now, locally and for good: virtual tables, exceptions and statics of a plugin stay valid to the end. Throws
/// PluginError "plugin.load", "plugin.no_entry".
const plugin::PluginEntry& open_library(const std::filesystem::path& file);

/// The strategies that the plugin registers, all or none. Throws PluginError "plugin.enroll".
std::vector<plugin::StrategyRecord> enroll(const plugin::PluginEntry& entry, const std::filesystem::path& file);

}  // namespace dsc::host
