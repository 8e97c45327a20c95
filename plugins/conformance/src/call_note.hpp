#pragma once
// Notes which call into a strategy is in progress, for the case that it ends the process.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::conformance {

/// In the process that starts a test: makes memory that it shares with the test, and empties it.
/// [setup]
void share_call_note();
/// The call that is in progress, "evaluate at step 2"; empty outside a call. The parent reads the
/// note of its child. [setup]
std::string call_in_progress();

/// Notes a call during the lifetime of the object. Where no note is shared, it does nothing. [step]
class Calling {
public:
    explicit Calling(std::string_view hook, std::optional<std::uint64_t> step = std::nullopt);
    ~Calling();
    Calling(const Calling&) = delete;
    Calling& operator=(const Calling&) = delete;
};

/// Makes the call with its note.
template <class Body>
decltype(auto) noted(std::string_view hook, std::optional<std::uint64_t> step, Body&& body) {
    const Calling calling(hook, step);
    return body();
}

}  // namespace dsc::conformance
