#pragma once
// A mark that says for whom a thread works. Workers pass it on to the threads of a loop.

namespace dsc {

/// The mark of the calling thread; null at first. It may be read in a signal handler. [parallel]
const void* thread_mark() noexcept;

/// Sets the mark of the calling thread, and returns the mark before. What it points to must exist
/// as long as the mark is set. [parallel]
const void* set_thread_mark(const void* mark) noexcept;

/// Sets the mark during the lifetime of the object. [parallel]
class ThreadMark {
public:
    explicit ThreadMark(const void* mark) noexcept : outer_(set_thread_mark(mark)) {}
    ~ThreadMark() { set_thread_mark(outer_); }
    ThreadMark(const ThreadMark&) = delete;
    ThreadMark& operator=(const ThreadMark&) = delete;

private:
    const void* outer_;
};

}  // namespace dsc
