#pragma once
// What a strategy promises of itself beyond its parameters; `dsc plugin check` holds it to that.

namespace dsc::hooks {

/// A strategy whose promises differ from these has a member `static constexpr dsc::hooks::Traits traits = {.rigid = false};`.
struct Traits {
    /// Answers depend on the experiment's seed, through StepContext::random(). Of all others the seed changes nothing.
    bool stochastic = false;
    /// A velocity or curvature that moves and turns with the surface and the cloud; false where a parameter names a place or
    /// a direction.
    bool rigid = true;
};

}  // namespace dsc::hooks
