#pragma once
// The inner loops of the winding field: sums over gathered sources, in float. Eight sums run side by side and are added up
// in one fixed order, and only operations that IEEE 754 rounds exactly are used, so a processor with wider registers gives
// the same bits.

#include <array>
#include <cstddef>
#include <vector>

namespace dsc::cloud {

/// Sums that run side by side.
inline constexpr std::size_t winding_lanes = 8;

/// Sources of one group of targets, one array per quantity: position, half the squared smoothing length, and a vector; sums of
/// scalars use only the vector's first component.
class WindingSources {
public:
    void clear() { count_ = 0; }
    void append(float x, float y, float z, float half_square, float a, float b, float c);
    /// Adds points begin..end-1 of seven arrays, given in the order of append().
    void append(const std::array<const float*, 7>& from, std::size_t begin, std::size_t end);
    /// Fills up with sources of no strength, to a whole number of lanes.
    void pad();
    std::size_t count() const { return count_; }
    const float* operator[](std::size_t quantity) const { return values_[quantity].data(); }

private:
    void reserve(std::size_t count);

    std::array<std::vector<float>, 7> values_;
    std::size_t count_ = 0;
};

/// One target.
struct WindingTarget {
    float x = 0.0F, y = 0.0F, z = 0.0F;
    float half_square = 0.0F;  ///< half its squared smoothing length
};

// With d = source - target and rho^2 = d^2 + both half squares; the factor 1 / (4 pi) is left to the caller.

/// Sum of (vector . d) / rho^3. [parallel]
float sum_winding(const WindingSources& sources, const WindingTarget& target);
/// Sum of -scalar d / rho^3: what each source, as a place where the winding number is wanted, does to the target's vector. [parallel]
std::array<float, 3> sum_adjoint(const WindingSources& sources, const WindingTarget& target);
/// Sum of vector / rho^3 - 3 (vector . d) d / rho^5. [parallel]
std::array<float, 3> sum_gradient(const WindingSources& sources, const WindingTarget& target);

}  // namespace dsc::cloud
