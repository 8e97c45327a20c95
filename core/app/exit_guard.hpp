#pragma once
// A plugin, or a library that it uses, may call exit() in the midst of a job. That must not look like success.

namespace dsc::app {

/// From now on an end of the process that main() does not know of (exit, quick_exit, _exit) is an error: it says which call
/// into a plugin it came from, the run folder says "failed", and the exit code is 4. Handlers run in the reverse order, so
/// whoever has just loaded plugins calls it once more, to come before theirs. A process that a fork made is left alone.
/// [setup]
void guard_exit();

/// Tells that main() ends as intended, so that the end of the process is not reported as a fault. Returns `code`. [setup]
int leave(int code) noexcept;

}  // namespace dsc::app
