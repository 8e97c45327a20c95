#include "exit_guard.hpp"

#include <atomic>
#include <cstdlib>
#include <string>

#include <sys/syscall.h>
#include <unistd.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/plugin/guarded.hpp>
#include <dsc/run/run_experiment.hpp>

#include "standard_streams.hpp"

namespace dsc::app {
namespace {

std::atomic<pid_t> guarded_process{0};
std::atomic<pid_t> refusing_thread{0};  // that handles the end of the process

/// Whether the process ends although main() has not ended. Returns true at the first call only: if
/// the thread that handles the end fails meanwhile, the process ends. Other threads that want to
/// end it wait, because the exit code is not theirs.
bool unexpected() noexcept {
    if (guarded_process != ::getpid()) return false;
    const pid_t self = ::gettid();
    pid_t handled_by = 0;
    if (refusing_thread.compare_exchange_strong(handled_by, self)) return true;
    while (handled_by != self) ::pause();
    return false;
}

[[noreturn]] void refuse_end() noexcept {
    try {
        const std::string call = plugin::current_call();
        const PluginError error("strategy.exit", call.empty() ? "a plugin or a library" : call,
                                "ended the process instead of throwing an exception",
                                "report this to the plugin's authors");
        tell(fmt::format("error: {}\n", error.what()));
        run::abandon_runs(error, !call.empty());
    } catch (...) {
        tell("error: a plugin or a library ended the process\n");
    }
    end_now(static_cast<int>(ExitCode::plugin));
}

void on_exit_of_anyone() {
    if (unexpected()) refuse_end();
}

}  // namespace

void end_now(int code) noexcept {
    while (true) ::syscall(SYS_exit_group, code);
}

void guard_exit() {
    guarded_process = ::getpid();
    // Each call of exit() takes the handlers from one list. If several threads of a strategy call
    // it, the second one takes the next handler, which must be a guard too and not a destructor of
    // what the first one still needs.
    constexpr int most_threads = 256;
    for (int i = 0; i < most_threads; ++i) {
        std::atexit(on_exit_of_anyone);
        std::at_quick_exit(on_exit_of_anyone);
    }
}

int leave(int code) noexcept {
    guarded_process = 0;
    return code;
}

}  // namespace dsc::app

// The program's functions take precedence over those of the C library: a plugin that calls one of
// these reaches the guard.
extern "C" {
__attribute__((visibility("default"))) void _exit(int code) {
    dsc::app::on_exit_of_anyone();
    dsc::app::end_now(code);
}
__attribute__((visibility("default"))) void _Exit(int code) noexcept {
    dsc::app::on_exit_of_anyone();
    dsc::app::end_now(code);
}
}
