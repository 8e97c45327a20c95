#include "duration.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <dsc/base/error.hpp>

namespace dsc::app {

double parse_duration(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    const double seconds = unit.empty() || unit == "s" ? 1.0
                           : unit == "m"               ? 60.0
                           : unit == "h"               ? 3600.0
                                                       : 0.0;
    if (error != std::errc() || seconds == 0.0 || !std::isfinite(value) || value <= 0.0) {
        throw UsageError("usage.duration", "--time-budget",
                         fmt::format("'{}' is not a length of time", text),
                         "write 90, 90s, 10m or 1.5h");
    }
    return value * seconds;
}

}  // namespace dsc::app
