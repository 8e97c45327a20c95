#pragma once
// The page that shows a run, and the page that compares several runs: a single file each, which
// needs no network.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/input.hpp>

namespace dsc::report {

/// The HTML of a finished run, made only from its folder and the cloud that its configuration
/// names; the bytes are always the same. `catalogue` creates the cloud's filters. `input`, if the
/// caller still has it, is the loaded input, so that the cloud need not be filtered again. If the
/// cloud or its filters no longer exist, the page says so. Throws IoError "report.no_run" for a
/// folder without a finished run, "report.damaged", and what readers of its files throw. [setup]
std::string report_html(const std::filesystem::path& run_folder, const plugin::Catalogue& catalogue,
                        Workers* workers = nullptr, const run::LoadedInput* input = nullptr);

/// A run of a comparison, and what the caller knows about it.
struct ComparedRun {
    std::filesystem::path folder;
    std::optional<std::size_t> index{};  ///< of its point in a sweep
    /// Dotted path and value of what the sweep has changed for it.
    std::vector<std::pair<std::string, std::string>> overrides{};
    /// Figures of surface::truth_figures(), if the sweep has a truth.
    std::vector<std::pair<std::string, double>> truth{};
};

/// Several runs next to each other, in the order of their indices if all have one. A run's name on
/// the page is what differs: its overrides, or the part of its folder's path that the others do not
/// have. Repeats are grouped, and two settings can be compared by pairs. Throws the same. [setup]
std::string comparison_html(std::span<const ComparedRun> runs, const plugin::Catalogue& catalogue,
                            Workers* workers = nullptr);

/// The libraries and folders that the experiments of these runs name under `plugins:`, each once.
/// Experiments that cannot be read are skipped. [setup]
std::vector<std::string> plugins_of_runs(std::span<const std::filesystem::path> run_folders);

/// Whether z is the up axis of a run's object in its picture and report: true for the built-in
/// shapes; models in files mostly use y. False if the folder does not say. [setup]
bool stands_along_z(const std::filesystem::path& run_folder);

}  // namespace dsc::report
