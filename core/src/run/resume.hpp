#pragma once
// Decides whether a run can continue in a folder. --resume never destroys a run that cannot be
// continued.

#include <filesystem>
#include <optional>
#include <string>

#include <dsc/run/experiment.hpp>

#include "checkpoints.hpp"
#include "contents.hpp"

namespace dsc::run {

/// The checkpoint from which the run of the folder continues. Empty if there is none and the run
/// may start at the beginning: the folder is new, or its run belongs to this experiment and wrote
/// no checkpoint. Throws UsageError "run.resume", with the difference, if the folder contains the
/// run of another experiment or of other versions of its plugins, or if none of its checkpoints can
/// be used. Changes nothing. [setup]
std::optional<Checkpoint> checkpoint_to_resume(const std::filesystem::path& folder,
                                               const Checkpoints& checkpoints,
                                               const LoadedExperiment& loaded,
                                               const plugin::Catalogue& catalogue,
                                               const std::string& hash);

/// The first differences of two experiments, "velocity.part is 0.05 there and 0.06 here"; empty if
/// there are none. [setup]
std::string experiment_differences(const config::ConfigNode& there, const config::ConfigNode& here);

}  // namespace dsc::run
