#pragma once
// Calls into strategies: whatever one throws or returns wrongly becomes an error that says which strategy of
// which plugin it was, in which hook and at which step. Catalogue::create wraps every strategy this way.

#include <cstdint>
#include <dsc/base/error.hpp>
#include <dsc/plugin/kind.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::plugin {

/// Who a strategy is, for messages.
struct Identity {
    Kind kind{};
    std::string id;
    std::string path;     ///< place in the experiment
    std::string plugin;   ///< name
    std::string version;  ///< of the plugin
    std::string file;     ///< of the plugin
    std::string place;    ///< "a.yaml:6:11" where its parameters stand; empty for parameters made by code

    /// "velocity 'point_cloud' (plugin point_cloud 0.1.0, FILE, at 'velocity' in the experiment, a.yaml:6:11)".
    std::string describe() const;
};

/// Which call it was.
struct Call {
    const Identity& who;
    std::string_view hook;              ///< "evaluate", ...
    std::optional<std::uint64_t> step;  ///< empty outside of steps
};

/// A fault of a strategy that is already attributed; passes through outer guards unchanged.
class StrategyFailure : public StrategyError {
public:
    StrategyFailure(std::string code, const std::string& message) : StrategyError(std::move(code), message) {}
    ~StrategyFailure() override;
};

/// Throws StrategyFailure "DESCRIPTION HOOK at step N CAUSE; REMEDY". Codes: "strategy.threw",
/// "strategy.not_finite", "strategy.size", "strategy.range", "strategy.outside".
[[noreturn]] void fail(const Call& call, std::string code, std::string_view cause, std::string_view remedy);

/// To be called in a catch block. CancelledError, ConfigError and StrategyFailure go on unchanged, outside of
/// steps IoError and GeometryError too (they concern the user's files); everything else becomes
/// StrategyFailure "strategy.threw".
[[noreturn]] void rethrow_attributed(const Call& call);

/// While it lives, this thread is inside of that call. [parallel]
class Inside {
public:
    explicit Inside(const Call& call) noexcept;
    ~Inside();
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

private:
    const Call* outer_;
};

/// The call into a strategy that this thread is in, the innermost: "DESCRIPTION: HOOK at step N"; empty outside. [parallel]
std::string current_call();

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
