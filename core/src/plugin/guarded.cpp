// Turns the faults of a strategy into errors that name it.
#include "dsc/plugin/guarded.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <exception>

#include <dsc/plugin/method_error.hpp>

namespace dsc::plugin {
namespace {

// Passes the parts of the text to `add`, one after the other.
template <class Add>
void describe(const Identity& who, const Add& add) {
    if (who.id.empty()) return add(std::string_view(who.file));  // a script that is being loaded
    for (const std::string_view part :
         {kind_name(who.kind), std::string_view(" '"), std::string_view(who.id),
          std::string_view("' (plugin "), std::string_view(who.plugin), std::string_view(" "),
          std::string_view(who.version), std::string_view(", "), std::string_view(who.file),
          std::string_view(", at '"), std::string_view(who.path),
          std::string_view("' in the experiment")})
        add(part);
    if (!who.place.empty()) {
        add(", ");
        add(who.place);
    }
    add(")");
}

template <class Add>
void describe(const Call& call, const Add& add) {
    describe(call.who, add);
    add(": ");
    add(call.hook);
    if (!call.step) return;
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), *call.step).ptr;
    add(" at step ");
    add(std::string_view(digits.data(), static_cast<std::size_t>(end - digits.data())));
}

std::string call_text(const Call& call) {
    std::string text;
    describe(call, [&text](std::string_view part) { text.append(part); });
    return text;
}

}  // namespace

std::string current_call() {
    const auto* const call = static_cast<const Call*>(thread_mark());
    return call == nullptr ? std::string() : call_text(*call);
}

std::size_t current_call(std::span<char> out) noexcept {
    std::size_t size = 0;
    const auto* const call = static_cast<const Call*>(thread_mark());
    if (call == nullptr) return size;
    describe(*call, [&](std::string_view part) {
        const std::size_t fits = std::min(part.size(), out.size() - size);
        std::copy_n(part.begin(), fits, out.begin() + static_cast<std::ptrdiff_t>(size));
        size += fits;
    });
    return size;
}

StrategyFailure::~StrategyFailure() = default;

std::string Identity::describe() const {
    std::string text;
    plugin::describe(*this, [&text](std::string_view part) { text.append(part); });
    return text;
}

void fail(const Call& call, std::string code, std::string_view cause, std::string_view remedy) {
    throw StrategyFailure(std::move(code), "", call_text(call).append(" ").append(cause), remedy);
}

/// The fault of a method: the same, with the name of the method in place of the hook's.
[[noreturn]] static void rethrow_of_method(const Call& call, const MethodError& error) {
    const std::string method = error.method();
    const Call renamed{call.who, method, call.step};
    try {
        std::rethrow_if_nested(error);
    } catch (...) {
        rethrow_attributed(renamed);
    }
    fail(renamed, "strategy.threw", "failed", "report this to the plugin's authors");
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
    } catch (const MethodError& error) {
        rethrow_of_method(call, error);
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
