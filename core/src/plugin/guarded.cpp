// Turns the faults of a strategy into errors that name it.
#include "dsc/plugin/guarded.hpp"

#include <exception>

namespace dsc::plugin {
namespace {

thread_local const Call* call_of_thread = nullptr;

std::string call_text(const Call& call) {
    std::string text = call.who.describe();
    text.append(": ").append(call.hook);
    if (call.step) text.append(" at step ").append(std::to_string(*call.step));
    return text;
}

}  // namespace

Inside::Inside(const Call& call) noexcept : outer_(call_of_thread) { call_of_thread = &call; }
Inside::~Inside() { call_of_thread = outer_; }

std::string current_call() {
    return call_of_thread == nullptr ? std::string() : call_text(*call_of_thread);
}

StrategyFailure::~StrategyFailure() = default;

std::string Identity::describe() const {
    std::string text(kind_name(kind));
    text.append(" '").append(id).append("' (plugin ").append(plugin).append(" ").append(version);
    text.append(", ").append(file).append(", at '").append(path).append("' in the experiment");
    if (!place.empty()) text.append(", ").append(place);
    return text + ")";
}

void fail(const Call& call, std::string code, std::string_view cause, std::string_view remedy) {
    throw StrategyFailure(std::move(code), "", call_text(call).append(" ").append(cause), remedy);
}

void rethrow_attributed(const Call& call) {
    constexpr std::string_view remedy =
        "check its parameters or report this to the plugin's authors";
    try {
        throw;
    } catch (const CancelledError&) {
        throw;
    } catch (const ConfigError&) {
        throw;
    } catch (const StrategyFailure&) {
        throw;
    } catch (const Error& error) {
        const bool users_file =
            error.exit_code() == ExitCode::io || error.exit_code() == ExitCode::geometry;
        if (!call.step && users_file) throw;
        fail(call, "strategy.threw", std::string("threw ") + error.code() + ": " + error.what(),
             remedy);
    } catch (const std::exception& error) {
        fail(call, "strategy.threw", std::string("threw: ") + error.what(), remedy);
    } catch (...) {
        fail(call, "strategy.threw", "threw something that is not a std::exception", remedy);
    }
}

}  // namespace dsc::plugin
