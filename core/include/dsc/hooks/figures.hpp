#pragma once
// Figures and warnings that a strategy adds to metrics.csv and summary.json.

#include <string>
#include <utility>
#include <vector>

namespace dsc::hooks {

/// Name and value; names are snake_case, the same in every step.
using Figures = std::vector<std::pair<std::string, double>>;

/// What a user must know before trusting a result, and what can be done.
struct Warning {
    std::string code;  ///< "topology.doubtful": stable, for programs
    std::string text;  ///< whole sentences
};
using Warnings = std::vector<Warning>;

}  // namespace dsc::hooks
