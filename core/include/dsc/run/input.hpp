#pragma once
// From the input of an experiment to the cloud that strategies see.

#include <cstddef>
#include <dsc/cloud/cloud.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/cloud/target.hpp>
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
    std::size_t used = 0;   ///< after the filters
    double diagonal = 0.0;  ///< of the used points' box, in the input's units
};

struct LoadedInput {
    cloud::Cloud cloud;  ///< filtered, in the input's units
    cloud::TargetCloud target;
    InputReport report;
};

/// Reads or samples, filters and normalises. `seed` is that of the experiment. Throws IoError, GeometryError as the
/// parts of the cloud module. [setup]
LoadedInput load_input(const Input& input, std::uint64_t seed);

/// Applies one filter of an experiment. [setup]
cloud::Filtered apply_filter(const cloud::Cloud& cloud, const config::StrategyConfig& filter);

/// The schema of a filter by its id, null for an unknown one; what it is for, on one line, empty for an unknown one; the
/// ids in alphabetical order. [setup]
const config::Schema* filter_schema(const std::string& id);
std::string filter_summary(const std::string& id);
std::vector<std::string> filter_ids();

}  // namespace dsc::run
