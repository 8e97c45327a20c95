#pragma once
// The job table of a sweep, jobs.tsv: what engines read, a line a point.

#include <cstddef>
#include <dsc/config/node.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace dsc::run {

/// A line of the table. Its index is its place, from 0 on.
struct SweepJob {
    std::string name;              ///< of the point; its folder is points/NAME
    config::ConfigNode overrides;  ///< dotted path to value
};

/// FOLDER/jobs.tsv
std::filesystem::path table_file(const std::filesystem::path& folder);

/// "points/NAME"
std::string point_folder(const std::string& name);

/// The table as text: a header, then index, folder and overrides (a flow map), parted by tabs.
std::string table_text(const std::vector<SweepJob>& jobs);

/// Reads it. Throws IoError "sweep.table" with the line for a table that expand did not write. [setup]
std::vector<SweepJob> read_table(const std::filesystem::path& folder);

}  // namespace dsc::run
