#pragma once
// The origin of a result: versions, machine, inputs and plugins by content.

#include <string>
#include <vector>

#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>

namespace dsc::run {

/// UTC, "2024-05-06T07:08:09Z".
std::string utc_now();

/// CPU time of this process and its peak memory.
struct Usage {
    double cpu_seconds = 0.0;
    double peak_rss_mb = 0.0;
};
Usage process_usage();

/// Returns `text` with the user's home folder (`home`, without a slash at its end) replaced by "~"
/// wherever a path begins with it. Unchanged if `home` is empty or "/".
std::string without_home(std::string text, const std::string& home);

/// Text of provenance.json. It contains no name of a user or a host and no environment; files of
/// the current folder have relative names, the home folder is "~". `finished` is empty while the
/// run continues. `wall_seconds` counts from its start. Throws IoError for an input or plugin that
/// cannot be read. [setup]
std::string provenance_json(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                            const std::string& hash, const std::vector<std::string>& command,
                            unsigned threads, const std::string& started,
                            const std::string& finished, double wall_seconds);

/// Several lines: version, compiler, fingerprint, libraries; for `dsc --version`.
std::string version_text();

}  // namespace dsc::run
