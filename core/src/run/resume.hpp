#pragma once
// Whether a run may go on in a folder: what is there and cannot be continued is never destroyed by --resume.

#include <dsc/run/experiment.hpp>
#include <filesystem>
#include <optional>
#include <string>

#include "checkpoints.hpp"

namespace dsc::run {

/// The checkpoint that the run of the folder goes on from; nothing where there is none and the run may begin from the start:
/// the folder is new, or its run was of this experiment and wrote no checkpoint. Throws UsageError "run.resume", with the
/// difference, where the folder has the run of another experiment or none of its checkpoints is of use. Changes nothing.
/// [setup]
std::optional<Checkpoint> checkpoint_to_resume(const std::filesystem::path& folder, const Checkpoints& checkpoints,
                                               const LoadedExperiment& loaded, const std::string& hash);

/// Where two experiments differ, "velocity.part is 0.05 there and 0.06 here", the first few places; empty where they do not.
/// [setup]
std::string experiment_differences(const config::ConfigNode& there, const config::ConfigNode& here);

}  // namespace dsc::run
