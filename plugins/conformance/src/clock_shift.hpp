#pragma once
// Other clocks for this process.

#include <array>
#include <cstddef>

namespace dsc::conformance {

/// How all clocks of the process differ from the real ones.
struct ClockShift {
    long seconds = 0;       ///< added to every clock
    long seconds_more = 0;  ///< added further at each reading, as on a slow machine
};

/// From now on the libraries that are loaded read the shifted clocks: clock_gettime(), time(),
/// gettimeofday(), timespec_get(), clock(), times(), and std::chrono through them. To be called
/// only in a process that runs one test. [setup]
void shift_clocks(const ClockShift& shift);

/// The clocks of det.clock, by which each strategy that reads a clock shows itself, whenever the
/// test runs. The first five and the true one divide the day into parts of 4 h 17 min and the year
/// into parts of two months, and fall on different days of the week. The next one is three years
/// earlier; with the last one each reading takes a minute.
inline constexpr std::array<ClockShift, 7> other_times = [] {
    constexpr long minute = 60;
    constexpr long hour = 60 * minute;
    constexpr long day = 24 * hour;
    std::array<ClockShift, 7> times{};
    for (std::size_t i = 0; i < 5; ++i)
        times[i].seconds = static_cast<long>(i + 1) * (61 * day + 4 * hour + 17 * minute);
    times[5].seconds = -3 * 365 * day;
    times[6].seconds_more = minute;
    return times;
}();

}  // namespace dsc::conformance
