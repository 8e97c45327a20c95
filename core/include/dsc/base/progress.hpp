#pragma once
// Cooperative cancellation: the caller of a long job creates a token and may set it from a signal
// handler.

#include <atomic>

namespace dsc {

/// Set once, read often. [parallel]
class CancelToken {
public:
    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
    bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

private:
    std::atomic<bool> cancelled_{false};
};

}  // namespace dsc
