#pragma once
// The search path for plugins.

#include <filesystem>
#include <string>
#include <vector>

#include <dsc/config/yaml.hpp>

namespace dsc::host {

/// A library or a folder of libraries.
struct SearchEntry {
    std::filesystem::path path;
    /// Where it was named: "--plugin", "plugins", "DSC_PLUGIN_PATH", "user folder" or "installed
    /// folder".
    std::string origin;
    bool required = false;  ///< named by the user: a fault in it is an error, not a warning
};

struct SearchOptions {
    std::vector<std::filesystem::path> command_line;  ///< --plugin, relative to the current folder
    std::vector<std::filesystem::path> experiment;    ///< `plugins:`, already absolute
    config::Environment environment = config::process_environment;
};

/// In order: --plugin, `plugins:`, DSC_PLUGIN_PATH (absolute names joined by colons),
/// $XDG_DATA_HOME/dsc/plugins (or ~/.local/share/dsc/plugins), the folder dsc/plugins beside the
/// running core library. The current folder is used only if the user names it. Folders of the user
/// and of the installation that do not exist are left out. Throws PluginError "plugin.search_path"
/// for a relative name in DSC_PLUGIN_PATH. [setup]
std::vector<SearchEntry> search_path(const SearchOptions& options);

/// The folder dsc/plugins beside the running core library. [setup]
std::filesystem::path installed_folder();

}  // namespace dsc::host
