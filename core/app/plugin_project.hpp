#pragma once
// The project that `dsc plugin new` writes: the templates with their values filled in.

#include <filesystem>
#include <string>
#include <vector>

#include <dsc/plugin/kind.hpp>

namespace dsc::app {

struct ProjectFile {
    std::string name;
    std::string text;
};

/// Throws UsageError "usage.plugin_name" unless it is [a-z][a-z0-9_]* and short enough for a
/// plugin's entry.
void require_plugin_name(const std::string& name);

/// The files of a plugin with one strategy; plugin and strategy have the same name.
std::vector<ProjectFile> plugin_project(const std::string& name, plugin::Kind kind);

/// Writes them into the new folder `place`, which is created completely or not at all. Throws
/// IoError.
void write_project(const std::filesystem::path& place, const std::vector<ProjectFile>& files);

}  // namespace dsc::app
