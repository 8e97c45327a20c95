#pragma once
// The results of a sweep: one row per point, repeats in groups, and paired comparisons of settings.

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/config/node.hpp>
#include <dsc/statistics/paired.hpp>

namespace dsc::sweep {

/// Progress of the points of a folder.
struct SweepStates {
    std::size_t points = 0;
    std::size_t done = 0;
    std::size_t failed = 0;      ///< ended with an error
    std::size_t unfinished = 0;  ///< running, stopped or killed
    std::size_t missing = 0;     ///< not started
};

/// What the folder of a point contains.
struct PointResult {
    std::string name;
    config::ConfigNode overrides;  ///< dotted path to value
    std::string status;            ///< done, failed, stopped, unfinished, missing
    std::string ended;             ///< how the schedule ended: converged, max_steps, ...
    std::string error;             ///< its error code
    std::map<std::string, std::string> figures;  ///< dotted name in summary.json to value
};

struct SweepResults {
    std::vector<PointResult> points;     ///< in the order of the job table
    std::vector<std::string> overrides;  ///< paths that at least one point overrides
    std::vector<std::string> figures;    ///< the main figures, in the order of the columns
    SweepStates states;
};

/// Reads the results. If the sweep has a truth, the result of every finished point is compared with
/// it (names `truth.*`); the figures are kept in the point's folder, and used again while neither
/// of the two surfaces changes. Throws UsageError "sweep.folder" for a folder without a job table,
/// IoError for a truth that cannot be read. [setup]
SweepResults collect_sweep(const std::filesystem::path& folder, Workers* workers = nullptr);

/// A CSV table with one row per point: index, folder and status, its overrides and the main
/// figures, empty if there are none. [setup]
std::string results_csv(const SweepResults& results);

/// A CSV table with one row per group of points that differ only in their seeds: the numbers of the
/// group and of the setting, n (the number of finished points), the overrides, and for each main
/// figure NAME the columns NAME.mean, NAME.deviation, NAME.low and NAME.high (statistics::Sample).
/// [setup]
std::string groups_csv(const SweepResults& results);

/// Two settings, over all seeds and clouds for which both have a finished point.
struct SettingsComparison {
    std::string first;  ///< the overrides of the setting, without seed and cloud
    std::string second;
    std::size_t pairs = 0;
    std::vector<std::pair<std::string, statistics::PairedComparison>> figures;  ///< main figures
};

/// Compares two settings by their numbers in groups_csv(). Throws UsageError "sweep.setting" for a
/// number that is too large, "sweep.pairs" without a pair. [setup]
SettingsComparison compare_settings(const SweepResults& results, std::size_t first,
                                    std::size_t second);

/// The point of a sweep to which a run belongs.
struct PointOfRun {
    std::size_t index = 0;  ///< in the job table
    config::ConfigNode overrides;
    std::vector<std::pair<std::string, double>> truth;  ///< figures without the prefix `truth.`
};

/// One entry per folder: the point, found by the place of the folder, points/NAME/run of a sweep;
/// empty for any other folder. A truth that cannot be read becomes a warning. Throws IoError
/// "sweep.table". [setup]
std::vector<std::optional<PointOfRun>> points_of_runs(
    std::span<const std::filesystem::path> run_folders, Workers* workers = nullptr);

}  // namespace dsc::sweep
