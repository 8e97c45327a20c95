#pragma once
// The job table of a sweep, jobs.tsv, which engines read: one line per point.

#include <filesystem>
#include <string>
#include <vector>

#include <dsc/config/node.hpp>

namespace dsc::sweep {

/// A line of the table. Its index is its position, from 0.
struct SweepJob {
    std::string name;              ///< of the point; its folder is points/NAME
    config::ConfigNode overrides;  ///< dotted path to value
};

/// FOLDER/jobs.tsv
std::filesystem::path table_file(const std::filesystem::path& folder);

/// "points/NAME"
std::string point_folder(const std::string& name);

/// The table as text: a header, then index, folder and overrides (a flow map), separated by tabs.
std::string table_text(const std::vector<SweepJob>& jobs);

/// Reads the table. Throws IoError "sweep.table" with the line if expand did not write it. [setup]
std::vector<SweepJob> read_table(const std::filesystem::path& folder);

}  // namespace dsc::sweep
