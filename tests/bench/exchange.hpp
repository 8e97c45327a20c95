#pragma once
// How near the cores of two threads are to each other.

namespace dsc::bench {

/// Time in nanoseconds after which one thread sees what another one has written, on the cores where
/// they run now. Threads that share data cannot be faster than it lets them. It is some 30 ns if
/// the cores have a common cache and some 200 ns if not; on a virtual machine it can change.
double exchange_ns();

}  // namespace dsc::bench
