#pragma once
// Measures are compared in steps of 1e-4, so that rounding does not decide the order.

#include <cmath>
#include <cstdint>

namespace dsc::improvement {

/// A quality, or a size in units of the target, as a whole number of steps of 1e-4. [parallel]
inline std::int64_t quantised(double value) { return std::llround(value * 1e4); }

}  // namespace dsc::improvement
