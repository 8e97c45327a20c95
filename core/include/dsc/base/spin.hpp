#pragma once
// Short waits for another thread, without the system.

#include <thread>

namespace dsc {

/// Tells the processor that the thread waits in a loop; a few nanoseconds. [parallel]
inline void spin_pause() noexcept {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#else
    std::this_thread::yield();
#endif
}

/// Waits until done() is true, or for some ten microseconds: a thread that sleeps needs longer than
/// that to wake up. False if done() is still false. [parallel]
template <class Done>
bool spin_until(const Done& done) noexcept {
    constexpr int rounds = 2000;
    for (int i = 0; i < rounds; ++i) {
        if (done()) return true;
        spin_pause();
    }
    return done();
}

}  // namespace dsc
