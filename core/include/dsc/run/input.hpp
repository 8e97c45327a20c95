#pragma once
// From the input of an experiment to the cloud that strategies see.

#include <cstddef>
#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dsc::run {

/// What became of the input.
struct InputReport {
    std::string source;       ///< file or shape
    std::string format;       ///< "OBJ", ..., or "sample"
    std::size_t points = 0;   ///< of the source
    std::size_t dropped = 0;  ///< not finite, left out by the reader
    std::vector<cloud::FilterReport> filters;
    double filter_seconds = 0.0;  ///< CPU seconds
    double filter_wall_seconds = 0.0;
    std::size_t used = 0;   ///< after the filters
    double diagonal = 0.0;  ///< of the used points' box, in the input's units
};

struct LoadedInput {
    cloud::Cloud cloud;  ///< filtered, in the input's units
    cloud::TargetCloud target;
    InputReport report;
    std::vector<Vec3> removed{};  ///< points of the file that no filter left where they were, in normalised units
};

/// Reads (through `files`) or samples, filters and normalises. `seed` is that of the experiment; `catalogue` makes the filters, which see
/// `workers` (null: one thread) and `cancel` (may be null). The result depends on neither. Throws IoError, GeometryError as the
/// parts of the cloud module, and as Catalogue::create and the filters: PluginError, StrategyError, CancelledError. [setup]
LoadedInput load_input(const Input& input, std::uint64_t seed, const plugin::Catalogue& catalogue, InputFiles& files,
                       Workers* workers = nullptr, const CancelToken* cancel = nullptr);

}  // namespace dsc::run
