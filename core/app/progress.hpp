#pragma once
// Shows the progress of a run to the user or to the calling program.

#include <functional>

#include <dsc/run/experiment.hpp>
#include <dsc/run/metrics.hpp>

#include "terminal.hpp"

namespace dsc::app {

void add_progress(CLI::App& command, TerminalOptions& options);

/// Reports steps on stderr: one line that is rewritten on a terminal and cut to its width; on a
/// terminal that cannot rewrite (TERM=dumb) and elsewhere a line every 10 % or 30 s; with "json" an
/// object per step; nothing with "never" or -q. Text that cannot be written is dropped.
std::function<void(const run::StepMetrics&, std::uint64_t planned)> progress_reporter(
    const TerminalOptions& options, const run::Experiment& experiment);

}  // namespace dsc::app
