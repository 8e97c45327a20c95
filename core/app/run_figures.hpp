#pragma once
// The figures that `dsc info` prints for a run folder.

#include <filesystem>

#include <nlohmann/json.hpp>

namespace dsc::app {

/// Reads the state, the files and the figures of a run from its folder. Throws IoError "io.no_run"
/// for a folder that is not a run folder. [setup]
nlohmann::ordered_json run_figures(const std::filesystem::path& folder);

}  // namespace dsc::app
