#pragma once
// Figures that a strategy adds to metrics.csv and summary.json.

#include <string>
#include <utility>
#include <vector>

namespace dsc::hooks {

/// Name and value; names are snake_case, the same in every step.
using Figures = std::vector<std::pair<std::string, double>>;

}  // namespace dsc::hooks
