#pragma once
// Tables 6.1 and 6.2 of the thesis [Saul2015] for several runs.

#include <span>
#include <string>

#include "record.hpp"

namespace dsc::report {

/// A run and its name on the page.
struct NamedRecord {
    const RunRecord* record = nullptr;
    std::string name;
};

/// Both tables with one row per run. Runs on the clouds bunny, teapot and cow have the values of
/// the thesis beside theirs; a cloud is recognised by the name of its file.
std::string thesis_comparison(std::span<const NamedRecord> runs);

}  // namespace dsc::report
