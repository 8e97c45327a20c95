#pragma once
// A second stack for the signal handlers of a thread, so that they also run when the thread's own
// stack is used up.

#include <cstddef>

namespace dsc {

/// Gives the calling thread a stack for handlers that are installed with SA_ONSTACK, until the
/// object is destroyed by the same thread. If there is no memory for it, or the build has a
/// sanitizer, which manages these stacks itself, the thread keeps the one that it has. [setup]
class SignalStack {
public:
    SignalStack() noexcept;
    ~SignalStack();
    SignalStack(const SignalStack&) = delete;
    SignalStack& operator=(const SignalStack&) = delete;

private:
    static constexpr std::size_t size = std::size_t{64} << 10U;  // of a handler that formats a text
    void* memory_ = nullptr;
};

}  // namespace dsc
