#pragma once
// Reports a finished run to the user.

#include <dsc/run/run_experiment.hpp>

namespace dsc::app {

/// Prints two or three lines on stderr.
void report(const run::RunOutcome& outcome);

/// 0, or 75 for a run that was stopped.
int exit_code(const run::RunOutcome& outcome);

}  // namespace dsc::app
