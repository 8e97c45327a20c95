#pragma once
// The figures that compare a result with the true surface, with the names under which they are
// written.

#include <string>
#include <utility>
#include <vector>

#include <dsc/surface/distance.hpp>

namespace dsc::surface {

/// Names and values, in the order in which `dsc evaluate` prints them. Names that end in `_percent`
/// are per cent; of distances, per cent of the diagonal of the true surface's box. [parallel]
std::vector<std::pair<std::string, double>> truth_figures(const Evaluation& evaluation);

}  // namespace dsc::surface
