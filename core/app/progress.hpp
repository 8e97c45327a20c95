#pragma once
// What a person, or the program that called, sees of a run while it goes on.

#include <dsc/run/experiment.hpp>
#include <dsc/run/figures.hpp>
#include <functional>

#include "terminal.hpp"

namespace dsc::app {

void add_progress(CLI::App& command, TerminalOptions& options);

/// Reports steps on stderr: one line that is rewritten on a terminal, elsewhere a line every 10 % or 30 s, with "json" an
/// object a step; nothing with "never" or -q.
std::function<void(const run::StepMetrics&, std::uint64_t planned)> progress_reporter(
    const TerminalOptions& options, const run::Experiment& experiment);

}  // namespace dsc::app
