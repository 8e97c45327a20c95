#pragma once
// Reads lengths of time on the command line.

#include <string>

namespace dsc::app {

/// Seconds of "90", "90s", "10m", "1.5h". Throws UsageError "usage.duration".
double parse_duration(const std::string& text);

}  // namespace dsc::app
