#pragma once
// What a person sees while a job goes on: log and progress on stderr, and the signals that end it.

#include <CLI/CLI.hpp>
#include <dsc/base/progress.hpp>
#include <dsc/run/figures.hpp>
#include <functional>
#include <string>

namespace dsc::app {

/// Options -v, -q and --progress.
struct TerminalOptions {
    bool verbose = false;
    bool quiet = false;
    std::string progress = "auto";  ///< auto, never, json
};
void add_verbosity(CLI::App& command, TerminalOptions& options);
void add_progress(CLI::App& command, TerminalOptions& options);

/// Sends the library's log to stderr. [setup]
void start_log(const TerminalOptions& options);

/// Reports steps on stderr: one line that is rewritten on a terminal, a JSON object a step, or nothing.
std::function<void(const run::StepMetrics&, std::uint64_t)> progress_reporter(const TerminalOptions& options);

/// Set by SIGINT and SIGTERM; the second signal ends the process at once. [setup]
const CancelToken& cancel_on_signals();

}  // namespace dsc::app
