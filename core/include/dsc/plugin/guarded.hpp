#pragma once
// Guarded calls into strategies: whatever a strategy throws or returns wrongly becomes an error
// that names the strategy, its plugin, the hook and the step. Catalogue::create wraps every
// strategy this way.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <dsc/base/error.hpp>
#include <dsc/base/thread_mark.hpp>
#include <dsc/plugin/kind.hpp>

namespace dsc::plugin {

/// Names a strategy in messages.
struct Identity {
    Kind kind{};
    std::string id;
    std::string path;     ///< place in the experiment
    std::string plugin;   ///< name
    std::string version;  ///< of the plugin
    std::string file;     ///< of the plugin
    std::string place;    ///< "a.yaml:6:11", the place of its parameters; empty for parameters made
                          ///< by code

    /// "velocity 'point_cloud' (plugin point_cloud 0.1.0, FILE, at 'velocity' in the experiment,
    /// a.yaml:6:11)".
    std::string describe() const;
};

/// Identifies the call.
struct Call {
    const Identity& who;
    std::string_view hook;              ///< "evaluate", ...
    std::optional<std::uint64_t> step;  ///< empty outside a step
};

/// A fault of a strategy that already names it; outer guards pass it on unchanged.
class StrategyFailure : public StrategyError {
public:
    using StrategyError::StrategyError;
    ~StrategyFailure() override;
};

/// Throws StrategyFailure "DESCRIPTION HOOK at step N CAUSE; REMEDY". Codes: "strategy.threw",
/// "strategy.not_finite", "strategy.size", "strategy.range", "strategy.outside".
[[noreturn]] void fail(const Call& call, std::string code, std::string_view cause,
                       std::string_view remedy);

/// Call it in a catch block. CancelledError, ConfigError and StrategyFailure are rethrown
/// unchanged; outside steps so are IoError and GeometryError, because they concern the user's
/// files. Everything else becomes StrategyFailure "strategy.threw".
[[noreturn]] void rethrow_attributed(const Call& call);

/// Marks that this thread, and the threads that help it in a loop of Workers, are inside that call,
/// during the lifetime of the object. [parallel]
class Inside {
public:
    explicit Inside(const Call& call) noexcept : mark_(&call) {}

private:
    ThreadMark mark_;
};

/// The innermost call into a strategy that this thread is in: "DESCRIPTION: HOOK at step N"; empty
/// outside a call. [parallel]
std::string current_call();

/// The same text, cut off at the end of `out`; returns its length. It needs no memory and no lock,
/// so a signal handler may call it. [parallel]
std::size_t current_call(std::span<char> out) noexcept;

/// Runs `body`, a call into a strategy. [parallel]
template <class Body>
decltype(auto) guarded(const Call& call, Body&& body) {
    const Inside inside(call);
    try {
        return body();
    } catch (...) {
        rethrow_attributed(call);
    }
}

}  // namespace dsc::plugin
