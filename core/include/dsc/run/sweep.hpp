#pragma once
// Sweeps: experiments that differ in a few values, a folder each, for an existing engine to carry out.

#include <cstddef>
#include <dsc/config/node.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace dsc::run {

/// One experiment of a sweep.
struct SweepPoint {
    std::string name;              ///< 12 hex digits made from the overrides, and from nothing else
    config::ConfigNode overrides;  ///< dotted path to value, in the order of the axes
};

/// A sweep file, its axes multiplied out.
struct Sweep {
    std::string base;        ///< the experiment that all points start from
    config::ConfigNode set;  ///< dotted path to value, for all points
    std::vector<SweepPoint> points;
    std::size_t repeated = 0;  ///< points left out because an earlier one is the same
};

/// Most points of a sweep.
constexpr std::size_t most_sweep_points = 20000;

/// The schema of a sweep file. The maps from dotted paths to values stand in it as maps without keys. [setup]
std::shared_ptr<const config::Schema> sweep_schema();

/// Reads a sweep file. Throws ConfigError with every fault that was found, IoError for an unreadable file. [setup]
Sweep load_sweep(const std::string& file, const config::YamlOptions& options = {});

/// Validates every point as `dsc run --check` does and returns the text of its experiment.yaml, all defaults written
/// out. Throws one ConfigError (IoError where only files are missing) with the faults of all points, each once, with
/// the first point that has it. [setup]
std::vector<std::string> sweep_experiments(const Sweep& sweep, const PluginLoader& load_plugins,
                                           const plugin::Catalogue& catalogue,
                                           const config::YamlOptions& options = {});

/// What expand_sweep() did.
struct Expansion {
    std::size_t added = 0;
    std::size_t kept = 0;
    std::size_t others = 0;  ///< points of the table that the sweep has no more; they stay
};

/// Writes FOLDER/points/NAME/experiment.yaml for every point, then FOLDER/jobs.tsv, which only ever grows: index,
/// folder, overrides. A folder that is there already is kept. Throws UsageError "sweep.folder" for a folder with
/// something else in it, "sweep.changed" where a point that was started would become another experiment. [setup]
Expansion expand_sweep(const Sweep& sweep, const std::vector<std::string>& experiments,
                       const std::filesystem::path& folder);

/// How far the points of a folder are.
struct SweepStates {
    std::size_t points = 0;
    std::size_t done = 0;
    std::size_t failed = 0;      ///< ended with an error
    std::size_t unfinished = 0;  ///< going on, stopped or killed
    std::size_t missing = 0;     ///< not started
};

/// One CSV table: index, folder and status of each point, its overrides and the headline figures of its summary.json,
/// empty where there are none. Throws UsageError "sweep.folder" for a folder without a job table. [setup]
std::string collect_sweep(const std::filesystem::path& folder, SweepStates& states);

}  // namespace dsc::run
