#include "clock_shift.hpp"

#include <array>
#include <atomic>

#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/times.h>
#include <time.h>
#include <unistd.h>

#include "interpose.hpp"

namespace dsc::conformance {
namespace {

std::atomic<long> offset{0};
std::atomic<long> growth{0};

/// The kernel's clock, because the function of the C library is replaced in this program too.
int shifted_clock(clockid_t clock, timespec* time) {
    const long result = ::syscall(SYS_clock_gettime, clock, time);
    if (result == 0 && time != nullptr) time->tv_sec += offset.fetch_add(growth) + growth;
    return static_cast<int>(result);
}

time_t shifted_time(time_t* out) {
    timespec now{};
    shifted_clock(CLOCK_REALTIME, &now);
    if (out != nullptr) *out = now.tv_sec;
    return now.tv_sec;
}

int shifted_timeofday(timeval* time, void*) {
    timespec now{};
    const int result = shifted_clock(CLOCK_REALTIME, &now);
    if (time != nullptr) *time = {now.tv_sec, now.tv_nsec / 1000};
    return result;
}

int shifted_timespec(timespec* time, int base) {
    return shifted_clock(CLOCK_REALTIME, time) == 0 ? base : 0;
}

clock_t shifted_cpu_clock() {
    timespec now{};
    shifted_clock(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<clock_t>(now.tv_sec) * CLOCKS_PER_SEC + now.tv_nsec / 1000;
}

clock_t shifted_times(tms* times) {
    timespec cpu{};
    timespec now{};
    shifted_clock(CLOCK_PROCESS_CPUTIME_ID, &cpu);
    shifted_clock(CLOCK_MONOTONIC, &now);
    const long ticks = ::sysconf(_SC_CLK_TCK);
    if (times != nullptr) *times = {cpu.tv_sec * ticks, 0, 0, 0};
    return now.tv_sec * ticks;
}

}  // namespace

void shift_clocks(const ClockShift& shift) {
    offset = shift.seconds;
    growth = shift.seconds_more;
    static bool replaced = false;
    if (replaced) return;
    replaced = true;
    const std::array<Replacement, 6> clocks = {
        Replacement{"clock_gettime", reinterpret_cast<void*>(shifted_clock)},
        {"time", reinterpret_cast<void*>(shifted_time)},
        {"gettimeofday", reinterpret_cast<void*>(shifted_timeofday)},
        {"timespec_get", reinterpret_cast<void*>(shifted_timespec)},
        {"clock", reinterpret_cast<void*>(shifted_cpu_clock)},
        {"times", reinterpret_cast<void*>(shifted_times)}};
    interpose(clocks);
}

}  // namespace dsc::conformance
