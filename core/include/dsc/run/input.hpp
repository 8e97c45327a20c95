#pragma once
// Makes the cloud that strategies see from the input of an experiment.

#include <cstddef>
#include <string>
#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/base/stopwatch.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/cloud/vary.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>

namespace dsc::run {

/// What the seed changed in the points, before the filters.
struct VariationReport {
    std::size_t left_out = 0;                 ///< number of points
    double jitter = 0.0;                      ///< standard deviation, in the input's units
    std::optional<Eigen::Matrix3d> rotation;  ///< empty if the cloud was not rotated
};

/// What happened to the input.
struct InputReport {
    std::string source;       ///< file or shape
    std::string format;       ///< "OBJ", ..., or "sample"
    std::size_t points = 0;   ///< number of points in the source
    std::size_t dropped = 0;  ///< points that are not finite; the reader left them out
    std::optional<VariationReport> variation;  ///< empty without `vary`
    std::vector<cloud::FilterReport> filters;
    Seconds filter_time;
    std::size_t used = 0;   ///< after the filters
    double diagonal = 0.0;  ///< of the used points' box, in the input's units
};

struct LoadedInput {
    cloud::Cloud cloud;  ///< filtered, in the input's units
    cloud::TargetCloud target;
    InputReport report;
    std::vector<Vec3> removed{};  ///< points of the file that a filter removed or moved, in
                                  ///< normalised units
};

/// Reads (through `files`) or samples, filters and normalises. `seed` is the seed of the
/// experiment. `catalogue` creates the filters, which may use `workers` (null: one thread) and
/// `cancel` (may be null). The result depends on neither. A variation of the input comes before the
/// filters; the cloud, the transform and the report are those of the input's coordinates. Throws
/// IoError, GeometryError as the parts of the cloud module, and as Catalogue::create and the
/// filters: PluginError, StrategyError, CancelledError. [setup]
LoadedInput load_input(const Input& input, std::uint64_t seed, const plugin::Catalogue& catalogue,
                       InputFiles& files, Workers* workers = nullptr,
                       const CancelToken* cancel = nullptr);

}  // namespace dsc::run
