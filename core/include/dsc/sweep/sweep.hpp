#pragma once
// Expands a parameter sweep into run folders; an existing engine executes the runs, and results.hpp
// collects what they have.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <dsc/config/node.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>

namespace dsc::sweep {

/// One experiment of a sweep.
struct SweepPoint {
    std::string name;              ///< 12 hex digits that depend only on the overrides
    config::ConfigNode overrides;  ///< dotted path to value, in the order of the axes
    config::ConfigEntry truth{"truth", config::ConfigNode()};  ///< file of the true surface,
                                                               ///< absolute; null without one
};

/// A sweep file with all combinations of its axes.
struct Sweep {
    std::string base;        ///< the experiment on which all points are based
    config::ConfigNode set;  ///< dotted path to value, for all points
    std::vector<SweepPoint> points;
    std::size_t repeated = 0;  ///< points left out because they equal an earlier one
};

/// Largest number of points of a sweep.
constexpr std::size_t most_sweep_points = 20000;

/// The schema of a sweep file. In it, the maps from dotted paths to values are maps without keys.
/// [setup]
std::shared_ptr<const config::Schema> sweep_schema();

/// Reads a sweep file. Throws ConfigError with every fault found, IoError for an unreadable file.
/// [setup]
Sweep load_sweep(const std::string& file, const config::YamlOptions& options = {});

/// Key of an axis that is not part of an experiment: the true surface with which the result is
/// compared.
inline constexpr const char* truth_key = "truth";

/// Validates every point as `dsc run --check` does and returns the texts of their experiment.yaml,
/// with all defaults written out. Throws one ConfigError (IoError if only files are missing) with
/// the faults of all points: each fault once, with the first point that has it. Points that differ
/// only in the seed are a fault ("config.sweep_repeat") if nothing in them depends on the seed.
/// [setup]
std::vector<std::string> sweep_experiments(const Sweep& sweep,
                                           const run::PluginLoader& load_plugins,
                                           const plugin::Catalogue& catalogue,
                                           const config::YamlOptions& options = {});

/// Report of expand_sweep().
struct Expansion {
    std::size_t added = 0;
    std::size_t kept = 0;
    std::size_t others = 0;  ///< points of the table that are no longer in the sweep; they are kept
};

/// Writes FOLDER/points/NAME/experiment.yaml for every point, and truth.json if it has a truth,
/// then FOLDER/jobs.tsv (index, folder, overrides). Lines of jobs.tsv are never removed, and an
/// existing folder of a point is kept. Throws UsageError "sweep.folder" for a folder with other
/// content, "sweep.changed" if a point that was started would become another experiment. [setup]
Expansion expand_sweep(const Sweep& sweep, const std::vector<std::string>& experiments,
                       const std::filesystem::path& folder);

}  // namespace dsc::sweep
