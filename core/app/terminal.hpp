#pragma once
// The log on stderr, and the signals that end a job.

#include <CLI/CLI.hpp>
#include <dsc/base/progress.hpp>
#include <string>

namespace dsc::app {

/// Options -v, -q and --progress.
struct TerminalOptions {
    bool verbose = false;
    bool quiet = false;
    std::string progress = "auto";  ///< auto, never, json
};
void add_verbosity(CLI::App& command, TerminalOptions& options);

/// Sends the library's log to stderr. [setup]
void start_log(const TerminalOptions& options);

/// Set by SIGINT, SIGTERM and SIGUSR1; the second signal ends the process at once. [setup]
const CancelToken& cancel_on_signals();

}  // namespace dsc::app
