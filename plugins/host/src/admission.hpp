#pragma once
// Checks of a plugin's file before any of its code runs.

#include <filesystem>

namespace dsc::host {

/// The file without symbolic links. Throws PluginError "plugin.open".
std::filesystem::path real_path(const std::filesystem::path& file);

/// Requires that nobody else can put a library there. Throws PluginError "plugin.writable".
void require_safe_folder(const std::filesystem::path& folder);
/// The same for one file that the user named, and for its folder.
void require_safe_file(const std::filesystem::path& real);

/// Requires a safe library with an entry that fits this dsc. Throws as the functions above,
/// read_entry() and require_fitting().
void require_admissible(const std::filesystem::path& real);

}  // namespace dsc::host
