#pragma once
// Where a result comes from: versions, machine, inputs and plugins by content.

#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <string>
#include <vector>

namespace dsc::run {

/// UTC, "2024-05-06T07:08:09Z".
std::string utc_now();

/// CPU time of this process and its peak memory.
struct Usage {
    double cpu_seconds = 0.0;
    double peak_rss_mb = 0.0;
};
Usage process_usage();

/// Text of provenance.json (without a user name or the environment). `finished` is empty while the run goes on.
/// Throws IoError for an input or plugin that cannot be read. [setup]
std::string provenance_json(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue,
                            const std::string& hash, const std::vector<std::string>& command,
                            unsigned threads, const std::string& started, const std::string& finished);

/// Several lines: version, compiler, fingerprint, libraries; for `dsc --version`.
std::string version_text();

}  // namespace dsc::run
