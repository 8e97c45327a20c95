#pragma once
// Asks the memory for data that will be used soon.

namespace dsc {

/// Asks for the line of the caches that contains this address, which need not be valid. It changes
/// nothing but the time.
inline void prefetch_line(const void* address) {
    __builtin_prefetch(address);
    // Without this, g++ takes a function that only prefetches for one without any effect, and
    // removes its calls.
    asm volatile("");
}

/// The same for data that will be written.
inline void prefetch_line_to_write(const void* address) {
    __builtin_prefetch(address, 1);
    asm volatile("");
}

}  // namespace dsc
