// What happens after a crash, and why this is sound.
//
// A signal handler may call only few functions: the thread may have been stopped inside malloc(),
// with its lock held, and the heap may be damaged. So the work is divided.
//
// - The handler, on a stack of its own because the thread's may be used up, puts the message
//   together in memory that exists from the start, writes it with write(2), wakes the rescuer, and
//   waits. It never returns to the code that crashed.
// - The rescuer is a thread that was started before and has slept since. For it nothing is special:
//   it is not inside any call, and has a heap arena of its own, so it may allocate memory and write
//   files although the thread that crashed still holds the locks of its arena. It writes
//   status.json first and then last_good/. It reads the complex while a strategy is called, and
//   during such a call no thread changes the complex: the thread of the run waits for the strategy.
//   So the state is not a copy that every step would pay for.
// - What can still go wrong, such as a lock of the log or memory that the strategy has overwritten,
//   is bounded: the handler waits at most `rescue_seconds`, and a crash of the rescuer ends the
//   wait. The message is already written, and the exit code is the same.
#include "crash_guard.hpp"

#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <thread>

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <semaphore.h>

#include <dsc/base/error.hpp>
#include <dsc/base/signal_stack.hpp>
#include <dsc/plugin/fingerprint.hpp>
#include <dsc/run/run_experiment.hpp>

#include "crash_text.hpp"
#include "exit_guard.hpp"
#include "standard_streams.hpp"

namespace dsc::app {
namespace {

constexpr std::array crash_signals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr int rescue_seconds = 60;

/// Everything that the handler needs; it is never destroyed.
struct Guard {
    std::vector<plugin::PluginInfo> plugins;
    bool core_dump = false;
    pid_t process = 0;
    sem_t crashed{};
    std::atomic<bool> busy{false};  // a crash is being handled
    std::atomic<bool> done{false};  // by the rescuer, whether or not it was successful
    std::atomic<bool> by_plugin{false};
    SignalStack stack;  // of the main thread

    // Set by the handler before it wakes the rescuer.
    CrashText text;
    bool in_call = false;
    CrashPlace place;
};
Guard* guard = nullptr;
thread_local bool is_rescuer = false;

/// The plugin whose library contains the address; null if there is none.
const plugin::PluginInfo* plugin_at(std::uintptr_t address) {
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {  // "7f00a0-7f00b0 r-xp ... FILE"
        char* after = nullptr;
        const std::uintptr_t begin = std::strtoull(line.c_str(), &after, 16);
        const std::uintptr_t end = std::strtoull(after + 1, nullptr, 16);
        if (address < begin || address >= end) continue;
        for (const plugin::PluginInfo& plugin : guard->plugins) {
            if (line.ends_with(plugin.file.string())) return &plugin;
        }
    }
    return nullptr;
}

constexpr std::string_view help = "to find the line of code, see share/doc/debugging.md, or report "
                                  "this to the plugin's authors";

/// A crash outside every call: of a thread that a plugin has started, or of the program itself.
Error outside_a_call() {
    const std::string cause(guard->text.view());
    if (const plugin::PluginInfo* plugin = plugin_at(guard->place.code)) {
        const std::string who = "plugin " + plugin->name + " (" + plugin->file.string() + ")";
        return StrategyError("strategy.crash", "",
                             who + " crashed in a thread of its own with " + cause, help);
    }
    return Error(ExitCode::internal, "internal.crash", "internal",
                 "dsc crashed outside every strategy with " + cause,
                 "please report it with the command");
}

void rescue() {
    if (guard->in_call) {
        run::abandon_runs(StrategyError("strategy.crash", "", guard->text.view(), help), true);
        return;
    }
    const Error error = outside_a_call();
    guard->by_plugin = error.exit_code() == ExitCode::plugin;
    tell(std::string("error: ") + error.what() + "\n");
    // The complex may be in the middle of a change.
    run::abandon_runs(error, false);
}

void be_rescuer() noexcept {
    is_rescuer = true;
    // The first allocation of a thread chooses its arena; a crash may come while all are locked.
    const std::vector<char> arena(1024);
    while (::sem_wait(&guard->crashed) != 0) {
    }
    try {
        rescue();
    } catch (const std::exception& error) {
        tell(std::string("warning: the run folder could not be updated: ") + error.what() + "\n");
    }
    guard->done = true;
}

[[noreturn]] void wait_for_the_end() noexcept {
    while (true) ::pause();
}

void wait_for_rescuer() noexcept {
    constexpr timespec moment{0, 5000000};
    constexpr int moments = rescue_seconds * 200;
    for (int i = 0; i < moments && !guard->done; ++i) ::nanosleep(&moment, nullptr);
    if (!guard->done) tell("warning: the run folder could not be updated in time\n");
}

/// The handler returns after this; the instruction that crashed, or the signal, then ends the
/// process in the way of the system, and a core file shows the place.
void end_by_signal(const siginfo_t& info) noexcept {
    ::signal(info.si_signo, SIG_DFL);
    if (info.si_code <= 0) ::raise(info.si_signo);
}

void describe_crash(const siginfo_t& info, const void* context) noexcept {
    guard->place = place_of(context);
    guard->in_call = guard->text.call();
    if (!guard->in_call) return add_cause(guard->text, info, guard->place);
    add_cause(guard->text << " crashed with ", info, guard->place);
}

void on_crash(int, siginfo_t* info, void* context) {
    const bool from_outside = info->si_code == SI_USER && info->si_pid != ::getpid();
    if (from_outside || ::getpid() != guard->process) return end_by_signal(*info);
    if (is_rescuer) {
        tell("warning: the run folder could not be updated, because the crash damaged memory\n");
        guard->done = true;
        wait_for_the_end();
    }
    if (guard->busy.exchange(true)) wait_for_the_end();
    describe_crash(*info, context);
    if (guard->in_call) {
        for (const std::string_view part : {std::string_view("error: "), guard->text.view(),
                                            std::string_view("; "), help, std::string_view("\n")})
            tell(part);
    }
    ::sem_post(&guard->crashed);
    wait_for_rescuer();
    if (guard->core_dump) return end_by_signal(*info);
    const bool plugins_fault = guard->in_call || guard->by_plugin;
    end_now(static_cast<int>(plugins_fault ? ExitCode::plugin : ExitCode::internal));
}

/// The rescuer gets no other signals, so that they reach the threads that expect them.
void start_rescuer() {
    sigset_t all;
    sigset_t before;
    ::sigfillset(&all);
    for (const int number : crash_signals) ::sigdelset(&all, number);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    std::thread(be_rescuer).detach();
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace

void guard_crashes(std::vector<plugin::PluginInfo> plugins) {
    const bool sanitized = plugin::core_fingerprint().find("san=none") == std::string_view::npos;
    if (sanitized) return;
    if (guard != nullptr) {
        guard->plugins = std::move(plugins);
        return;
    }
    guard = new Guard;
    guard->plugins = std::move(plugins);
    guard->process = ::getpid();
    const char* const wanted = std::getenv("DSC_CORE_DUMP");
    guard->core_dump = wanted != nullptr && std::string_view(wanted) == "1";
    ::sem_init(&guard->crashed, 0, 0);
    start_rescuer();
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    for (const int number : crash_signals) ::sigaddset(&action.sa_mask, number);
    for (const int number : crash_signals) ::sigaction(number, &action, nullptr);
}

}  // namespace dsc::app
