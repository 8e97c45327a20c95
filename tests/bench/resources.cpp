#include "resources.hpp"

#include <ctime>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace dsc::bench {

double cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double peak_rss_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

double rss_mb() {
    std::ifstream file("/proc/self/statm");
    double total = 0.0, resident = 0.0;
    file >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

extern "C" [[gnu::noinline]] void dsc_measured(detail::Thunk call, void* work) {
    call(work);
    // Without something after it the call would become a jump, and callgrind would never see this
    // function end.
    asm volatile("" ::: "memory");
}

}  // namespace dsc::bench
