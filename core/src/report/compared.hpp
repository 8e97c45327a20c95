#pragma once
// The runs of a comparison: what differs between them, their names on the page, and their groups.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <dsc/report/report.hpp>
#include <dsc/statistics/groups.hpp>

#include "record.hpp"

namespace dsc::report {

/// One run.
struct Compared {
    RunRecord record;
    std::size_t index = 0;  ///< of the point of the sweep, else the position
    std::string name;       ///< what differs from the other runs; no two runs have the same name
    std::map<std::string, std::string> values;  ///< of the experiment, by dotted path
    std::vector<std::pair<std::string, double>> truth;

    /// A value of the summary by its path, or a figure of the truth ("truth.NAME"); NaN if there is
    /// none.
    double figure(const std::string& path) const;
    /// The value at a path of the experiment; "-" if there is none.
    std::string value(const std::string& path) const;
};

/// All runs of a page.
struct Comparison {
    std::vector<Compared> runs;
    std::vector<std::string> paths;   ///< of all experiments, in their order
    std::vector<std::string> differ;  ///< the paths that differ
    std::vector<std::string> keys;  ///< those that name the runs of a sweep; otherwise as `differ`
    bool sweep = false;             ///< all runs are points of a sweep
    std::vector<statistics::Identity> identities;
    std::vector<statistics::Group> groups;  ///< runs that differ only in their seeds

    bool repeated() const { return groups.size() < runs.size(); }
    std::size_t settings() const;
    /// The last parts of a path that no other key ends with: "alpha" for "velocity.alpha".
    std::string short_key(const std::string& path) const;
    /// What distinguishes a group, without the seed.
    std::string group_name(const statistics::Group& group) const;
    /// What distinguishes a setting, without seed and cloud.
    std::string setting_name(std::size_t setting) const;
    /// The runs that a page shows first: the first run of each of the first eight groups.
    std::vector<std::size_t> shown() const;
};

/// Reads the runs. Throws as read_record. [setup]
Comparison compare_runs(std::span<const ComparedRun> runs);

/// The parts of paths that are not common to all: "a" and "b" for "runs/a/run" and "runs/b/run".
std::vector<std::string> distinct_parts(const std::vector<std::filesystem::path>& paths);

}  // namespace dsc::report
