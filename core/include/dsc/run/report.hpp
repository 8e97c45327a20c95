#pragma once
// The page that shows a run, and the one that compares several: a single file each, which needs no network.

#include <dsc/base/workers.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/input.hpp>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace dsc::run {

/// The HTML of a finished run, made from its folder alone and the cloud that its configuration names: the same bytes whenever
/// it is asked for. `catalogue` makes the cloud's filters; `input` is what they gave, for the run that has it still, and saves
/// filtering the cloud again. A cloud that is gone, or whose filters are, is said to be missing.
/// Throws IoError "report.no_run" for a folder without a finished run, "report.damaged", and what readers of its files throw.
/// [setup]
std::string report_html(const std::filesystem::path& run_folder, const plugin::Catalogue& catalogue, Workers* workers = nullptr,
                        const LoadedInput* input = nullptr);

/// Several runs side by side. Throws the same. [setup]
std::string comparison_html(std::span<const std::filesystem::path> run_folders, const plugin::Catalogue& catalogue,
                            Workers* workers = nullptr);

/// The libraries and folders that the experiments of these runs name under `plugins:`, each once. What cannot be read
/// names none. [setup]
std::vector<std::string> plugins_of_runs(std::span<const std::filesystem::path> run_folders);

/// Whether the object of a run stands along z, as its picture and its report have it: the built-in shapes do, models in files
/// mostly along y. False for a folder that does not tell. [setup]
bool stands_along_z(const std::filesystem::path& run_folder);

}  // namespace dsc::run
