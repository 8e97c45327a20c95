// Gives threads a second stack for their signal handlers.
#include "dsc/base/signal_stack.hpp"

#include <signal.h>
#include <sys/mman.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DSC_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DSC_SANITIZED 1
#endif
#endif

namespace dsc {

SignalStack::SignalStack() noexcept {
#ifndef DSC_SANITIZED
    void* const memory =
        ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return;
    stack_t stack{};
    stack.ss_sp = memory;
    stack.ss_size = size;
    if (::sigaltstack(&stack, nullptr) == 0) {
        memory_ = memory;
    } else {
        ::munmap(memory, size);
    }
#endif
}

SignalStack::~SignalStack() {
    if (memory_ == nullptr) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    ::sigaltstack(&none, nullptr);
    ::munmap(memory_, size);
}

}  // namespace dsc
