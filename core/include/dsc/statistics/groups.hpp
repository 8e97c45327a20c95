#pragma once
// Groups the runs of an experiment: repeats of one setting, and pairs of two settings.

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace dsc::statistics {

/// Dotted path of the experiment and its value as text.
using KeyValue = std::pair<std::string, std::string>;

/// Whether a key decides what a run sees, not how it works: everything below `input.cloud` except
/// its filters, and `truth`, the surface with which results are compared. [parallel]
bool is_data_key(const std::string& path);

/// What a run has in common with others.
struct Identity {
    std::string setting;  ///< all values that are neither the seed nor data
    std::string data;     ///< the values of the data keys
    std::string seed;     ///< empty if the keys have none
};

/// The identity of a run with these values; their order has no influence. [parallel]
Identity identity_of(std::span<const KeyValue> values);

/// Runs of one setting on the same data; they differ only in their seeds.
struct Group {
    std::vector<std::size_t> runs;  ///< indices of the runs, ascending
    std::size_t setting = 0;        ///< number of the setting; settings are numbered from 0 in the
                                    ///< order of their first runs
};

/// All groups in the order of their first runs. [parallel]
std::vector<Group> group_runs(std::span<const Identity> runs);

/// The runs of two settings with the same data and the same seed, in the order of the first
/// setting's runs. If a setting has several such runs, its first one is used. [parallel]
std::vector<std::pair<std::size_t, std::size_t>> pair_runs(std::span<const Identity> runs,
                                                           const std::string& first,
                                                           const std::string& second);

}  // namespace dsc::statistics
