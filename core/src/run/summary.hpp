#pragma once
// The texts of summary.json and status.json.

#include <map>
#include <optional>
#include <string>

#include <dsc/run/input.hpp>
#include <dsc/run/measure.hpp>
#include <dsc/run/provenance.hpp>
#include <dsc/run/run_experiment.hpp>
#include <dsc/run/simulation.hpp>
#include <dsc/surface/distance.hpp>

namespace dsc::run {

/// The data of summary.json.
struct SummaryParts {
    const LoadedExperiment& loaded;
    const std::string& hash;
    const LoadedInput* input;                                  ///< null without a cloud
    const std::optional<surface::CloudEvaluation>& distances;  ///< normalised units
    const RunOutcome& outcome;
    cloud::Transform to_normalised;
    double wall_seconds;
    Usage usage;
};
std::string summary_json(const SummaryParts& parts);

/// The data of status.json.
struct RunState {
    std::string state;  ///< running, done, stopped, failed
    std::string hash;
    std::map<std::string, std::string> strategies;  ///< SHA-256 of the plugin of each, by "KIND ID"
    std::string started;
    std::string finished;             ///< empty while running
    std::optional<RunTotals> totals;  ///< for a run that ended normally
    int exit_code = 0;
    std::string error_code;
    std::string error;
};
std::string status_json(const RunState& state);

}  // namespace dsc::run
