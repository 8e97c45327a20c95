#pragma once
// The option --threads.

#include <CLI/CLI.hpp>

namespace dsc::app {

/// Adds the option --threads to a command. `threads` stays 0 if the option is not given.
void add_threads(CLI::App& command, unsigned& threads);

/// The number of threads to use: `threads`, or one per core if it is 0.
unsigned thread_count(unsigned threads);

}  // namespace dsc::app
