#pragma once
// What is judged of a plugin's file while nothing of it runs.

#include <filesystem>

namespace dsc::host {

/// The file without symbolic links. Throws PluginError "plugin.open".
std::filesystem::path real_path(const std::filesystem::path& file);

/// Nobody else may be able to put a library there. Throws PluginError "plugin.writable".
void require_safe_folder(const std::filesystem::path& folder);
/// The same for one file, which the user named, and for the folder that it lies in.
void require_safe_file(const std::filesystem::path& real);

/// Safe, a library with an entry, and built to fit. Throws as these do, and as read_entry() and require_fitting().
void require_admissible(const std::filesystem::path& real);

}  // namespace dsc::host
