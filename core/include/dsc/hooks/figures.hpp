#pragma once
// Figures and warnings that a strategy adds to metrics.csv and summary.json.

#include <string>
#include <utility>
#include <vector>

namespace dsc::hooks {

/// Name and value. Names are snake_case and the same in every step.
using Figures = std::vector<std::pair<std::string, double>>;

/// What a user must know before trusting a result, and what the user can do about it.
struct Warning {
    std::string code;  ///< "topology.doubtful": stable, for programs
    std::string text;  ///< complete sentences
};
using Warnings = std::vector<Warning>;

}  // namespace dsc::hooks
