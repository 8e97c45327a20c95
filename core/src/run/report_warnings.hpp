#pragma once
// What a reader of a report must know before trusting it.

#include <string>
#include <vector>

#include "report_record.hpp"

namespace dsc::run {

/// A property that a result as written must have.
struct Check {
    std::string name;
    std::string value;
    bool holds = false;
};
std::vector<Check> validity(const RunRecord& record);

/// One sentence each; empty for a run without anything to mind.
std::vector<std::string> warnings(const RunRecord& record);

}  // namespace dsc::run
