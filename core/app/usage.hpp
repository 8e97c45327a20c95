#pragma once
// Wrong calls: what was meant, and where it is written.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace dsc::app {

/// One line about a call that the parser refuses, without "error: ": an unknown command or option is named, with the one that
/// was probably meant. `words`: the call as typed, without the program. [setup]
std::string usage_text(const CLI::App& app, const std::vector<std::string>& words, const CLI::ParseError& error);

/// The help of the command that the words name, of `app` for none. Throws UsageError "usage.command" for an unknown one. [setup]
std::string help_text(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace dsc::app
