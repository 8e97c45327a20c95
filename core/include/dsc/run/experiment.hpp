#pragma once
// An experiment: the typed form of a configuration, and how a file with overrides is turned into
// it.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <dsc/cloud/vary.hpp>
#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>
#include <dsc/config/params.hpp>
#include <dsc/config/schema.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/run/input_files.hpp>

namespace dsc::run {

/// A cloud sampled from a built-in shape (cloud/shapes.hpp).
struct SampleInput {
    std::string shape = "teapot";
    std::uint64_t n = 10000;
    double noise = 0.0;
    double outliers = 0.0;
};

/// Source of the points: exactly one of `file` and `sample`.
struct CloudInput {
    std::optional<std::string> file;   ///< absolute
    std::vector<std::string> columns;  ///< of a text cloud (cloud::ReadOptions); empty: by the
                                       ///< header, else the first three
    std::optional<SampleInput> sample;
    std::optional<cloud::Variation> vary;  ///< before the filters; drawn by the experiment's seed
    std::vector<config::StrategyConfig> filters;  ///< of kind "filter", in the order in which they
                                                  ///< are applied
};

/// The thesis' normalisation.
struct NormalizeInput {
    double scale = 0.9;  ///< longest half-extent of the cloud in normalised units
};

struct Input {
    CloudInput cloud;
    std::optional<NormalizeInput> normalize;  ///< empty: the coordinates are not changed
};

/// What ends a series of steps before its number of steps is reached.
enum class Until { finished };  ///< the velocity's finished()

/// An item of the schedule: steps, a refinement, or steps with a refinement after a number of them.
struct Series {
    std::optional<std::uint32_t> steps;
    std::optional<std::uint32_t> every;
    config::StrategyConfig refine;
    std::optional<Until> until;
};

/// The rule that ends a series of steps early.
struct Stop {
    double speed = 1.0e-3;  ///< current mean edges per step
    std::uint32_t patience = 3;
};

/// When the state of the run is saved, besides the moment when it is stopped.
struct CheckpointOutput {
    std::uint32_t every = 20;  ///< steps
    std::uint32_t keep = 2;    ///< number of saved states that are kept
};
/// States for ParaView.
struct SeriesOutput {
    std::uint32_t every = 10;
};

/// The part of the surface that is written: without faces that have a vertex too far from the
/// points or with too little support.
struct TrimOutput {
    double distance = 2.0;  ///< spacings of the points
    double support = 0.0;   ///< least value of the velocity's attribute of this name
};

struct Output {
    std::vector<std::string> surface = {"obj", "ply"};
    std::vector<std::string> volume = {"vtu", "dsc"};
    std::optional<CheckpointOutput> checkpoint;
    std::optional<SeriesOutput> series;
    std::optional<TrimOutput> trim;  ///< empty: the closed surface
    std::optional<bool> report;
    std::optional<bool> normals;
    std::optional<bool> preview;   ///< empty: true
    std::optional<bool> compress;  ///< empty: false
};

/// Everything on which a run depends, defaults included.
struct Experiment {
    std::uint32_t format = 1;  ///< key `dsc`
    std::string name;
    std::uint64_t seed = 1;
    std::vector<std::string> plugins;  ///< libraries or folders, absolute
    std::optional<Input> input;
    config::StrategyConfig initial_mesh;
    config::StrategyConfig velocity;
    config::StrategyConfig improvement;
    std::vector<Series> schedule;
    std::optional<Stop> stop;
    std::vector<config::StrategyConfig> observers;
    Output output;

    static void declare(config::ParamSchema<Experiment>& schema);
};

/// The schema of format 1. [setup]
std::shared_ptr<const config::Schema> experiment_schema();

/// A validated experiment.
struct LoadedExperiment {
    Experiment experiment;
    config::ConfigNode resolved;  ///< all defaults written out, file names absolute
    std::string warnings;         ///< text of the warnings; empty if there are none
    /// The files that the experiment reads, each read once.
    std::shared_ptr<InputFiles> files = std::make_shared<InputFiles>();
};

/// Provides the lookup of strategies after the plugins of the experiment are loaded: receives the
/// absolute paths of `plugins:` and returns a lookup that outlives the call.
using PluginLoader = std::function<const config::StrategyLookup&(const std::vector<std::string>&)>;

/// Reads `file` and applies the overrides; an experiment without a name gets that of the file.
/// Throws ConfigError, IoError for an unreadable file. [setup]
config::ConfigNode read_experiment(const std::string& file, std::span<const std::string> overrides,
                                   const config::YamlOptions& options = {});

/// read_experiment(); then it loads the plugins and validates. Throws ConfigError with every fault
/// found, IoError for an unreadable file, and what the loader throws. [setup]
LoadedExperiment load_experiment(const std::string& file, std::span<const std::string> overrides,
                                 const PluginLoader& load_plugins,
                                 const config::YamlOptions& options = {});

/// The same for a tree made by code. [setup]
LoadedExperiment resolve_experiment(const config::ConfigNode& root,
                                    const PluginLoader& load_plugins);

/// The input of a resolved configuration; `lookup` knows its filters. Empty if there is no input.
/// Throws ConfigError, also for a filter that the lookup does not know. [setup]
std::optional<Input> input_of(const config::ConfigNode& resolved,
                              const config::StrategyLookup& lookup);

/// The text that `--print-config` prints and config.resolved.yaml contains.
std::string resolved_text(const LoadedExperiment& loaded);

/// SHA-256 (64 hex digits) of the canonical resolved configuration. A file parameter is hashed by
/// its content instead of its name, and so are plugins. Throws IoError for a file that cannot be
/// read. [setup]
std::string config_hash(const LoadedExperiment& loaded, const config::StrategyLookup& lookup);

/// Files that the experiment names in its input and its strategies' parameters, in the order of the
/// schema. [setup]
std::vector<std::string> input_files(const LoadedExperiment& loaded,
                                     const config::StrategyLookup& lookup);

}  // namespace dsc::run
