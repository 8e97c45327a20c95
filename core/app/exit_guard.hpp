#pragma once
// A plugin, or a library that it uses, may call exit() during a job. This must not look like
// success.

namespace dsc::app {

/// From now on it is an error if the process ends without main() (exit, quick_exit, _exit): the
/// message states which call into a plugin caused it, the run folder records "failed" and keeps the
/// last good state, and the exit code is 4. Handlers run in the reverse order, so call this again
/// after loading plugins, so that it runs before their handlers. It does nothing in a process made
/// by fork(). [setup]
void guard_exit();

/// Records that main() ends as intended, so that the end of the process is not reported as an
/// error. Returns `code`. [setup]
int leave(int code) noexcept;

/// Ends the process without any handler or destructor. A signal handler may call it.
[[noreturn]] void end_now(int code) noexcept;

}  // namespace dsc::app
