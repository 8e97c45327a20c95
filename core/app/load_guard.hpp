#pragma once
// A Python file runs while it is loaded: it may crash, end the process, or never end.

#include <signal.h>

namespace dsc::app {

/// During the lifetime of the object, a crash and the first Ctrl-C name the file that is being
/// loaded. To be used by the main thread. [setup]
class LoadGuard {
public:
    LoadGuard();
    ~LoadGuard();
    LoadGuard(const LoadGuard&) = delete;
    LoadGuard& operator=(const LoadGuard&) = delete;

private:
    struct sigaction before_ {};
};

}  // namespace dsc::app
