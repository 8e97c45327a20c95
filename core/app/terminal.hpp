#pragma once
// The log on stderr, and the signals that end a job.

#include <string>

#include <CLI/CLI.hpp>

#include <dsc/base/progress.hpp>

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

/// Set by SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGUSR1; a second SIGINT or SIGTERM ends the process
/// at once. A SIGHUP that was ignored when the program started stays ignored. [setup]
const CancelToken& cancel_on_signals();

}  // namespace dsc::app
