#pragma once
// Cooperative cancellation: the caller of a long job creates a token and may set it from a signal
// handler.

#include <atomic>
#include <chrono>
#include <optional>

namespace dsc {

/// Set once, read often. [parallel]
class CancelToken {
public:
    using Clock = std::chrono::steady_clock;

    CancelToken() = default;
    /// A token that is also cancelled when `outer` is, which may be null and must outlive it, and
    /// from `deadline` on.
    explicit CancelToken(const CancelToken* outer,
                         std::optional<Clock::time_point> deadline = std::nullopt)
        : outer_(outer), deadline_(deadline) {}

    void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }

    /// Whether the job shall end. It also notes for told() that somebody got the answer true.
    bool cancelled() const noexcept {
        if (!requested()) return false;
        told_.store(true, std::memory_order_relaxed);
        return true;
    }
    /// The same answer, for the one who owns the job: told() does not change.
    bool requested() const noexcept {
        return cancelled_.load(std::memory_order_relaxed) ||
               (outer_ != nullptr && outer_->requested()) ||
               (deadline_ && Clock::now() >= *deadline_);
    }
    /// Whether cancelled() has returned true: whoever asked may have left its work unfinished.
    bool told() const noexcept { return told_.load(std::memory_order_relaxed); }

private:
    std::atomic<bool> cancelled_{false};
    mutable std::atomic<bool> told_{false};
    const CancelToken* outer_ = nullptr;
    std::optional<Clock::time_point> deadline_{};
};

}  // namespace dsc
