#pragma once
// What a measurement reads: the CPU time of this process, its memory, and the order statistics of
// repeated values.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dsc::bench {

/// User and system time of this process in seconds. Not wall time: on a shared machine that
/// measures the neighbours.
double cpu_seconds();
/// Largest resident size that the process ever had, in MB (10^6 bytes).
double peak_rss_mb();
/// Resident size now, in MB.
double rss_mb();

/// CPU seconds that a call takes.
template <class Work>
double cpu_of(Work&& work) {
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
}

/// The value below which the part `p` in [0, 1] of the values lies; 0 without values.
inline double quantile(std::vector<double> values, double p) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const double place = p * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::size_t>(place);
    const std::size_t high = std::min(low + 1, values.size() - 1);
    return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}
inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }

namespace detail {
using Thunk = void (*)(void*);
}
extern "C" void dsc_measured(detail::Thunk call, void* work);

/// Runs the work inside the function dsc_measured, at whose name callgrind switches its counting on
/// and off.
template <class Work>
void measured(Work work) {
    dsc_measured([](void* object) { (*static_cast<Work*>(object))(); }, &work);
}

}  // namespace dsc::bench
