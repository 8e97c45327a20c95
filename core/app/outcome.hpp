#pragma once
// What a finished run tells its user.

#include <dsc/run/runner.hpp>

namespace dsc::app {

/// Two or three lines on stderr.
void report(const run::RunOutcome& outcome);

/// 0, or 75 for a run that was stopped.
int exit_code(const run::RunOutcome& outcome);

}  // namespace dsc::app
