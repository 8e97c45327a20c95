#pragma once
// Other clocks for this process.

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

}  // namespace dsc::conformance
