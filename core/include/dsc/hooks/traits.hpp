#pragma once
// Properties that a strategy promises besides its parameters; `dsc plugin check` tests them.

namespace dsc::hooks {

/// A strategy with other properties has a member `static constexpr dsc::hooks::Traits traits =
/// {.rigid = false};`.
struct Traits {
    /// The answers depend on the experiment's seed, through StepContext::random(). If false, the
    /// seed has no influence.
    bool stochastic = false;
    /// The answers of a velocity or curvature move and rotate with the surface and the cloud; false
    /// if a parameter is a place or a direction.
    bool rigid = true;
};

}  // namespace dsc::hooks
