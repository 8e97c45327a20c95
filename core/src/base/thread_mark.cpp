// The mark of each thread.
#include "dsc/base/thread_mark.hpp"

namespace dsc {
namespace {

// The library is loaded with the program, so this needs no memory when a thread reads it first.
thread_local const void* mark_of_thread = nullptr;

}  // namespace

const void* thread_mark() noexcept { return mark_of_thread; }

const void* set_thread_mark(const void* mark) noexcept {
    const void* const before = mark_of_thread;
    mark_of_thread = mark;
    return before;
}

}  // namespace dsc
