#pragma once
// Messages for wrong calls: the command or option that was probably meant, and where the help is.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace dsc::app {

/// One line about a call that the parser refuses, without "error: ". It names an unknown command or
/// option, and the one that was probably meant. `words`: the call as typed, without the name of the
/// program. [setup]
std::string usage_text(const CLI::App& app, const std::vector<std::string>& words,
                       const CLI::ParseError& error);

/// The help of the command that `words` names. If there are no words, the help of `app`. Throws
/// UsageError "usage.command". [setup]
std::string help_text(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace dsc::app
