#pragma once
// What a reader of a report must know before trusting the result.

#include <string>
#include <vector>

#include "record.hpp"

namespace dsc::report {

/// A property that a written result must have.
struct Check {
    std::string name;
    std::string value;
    bool holds = false;
};
std::vector<Check> validity(const RunRecord& record);

/// One sentence each; empty for a run without problems.
std::vector<std::string> warnings(const RunRecord& record);

}  // namespace dsc::report
