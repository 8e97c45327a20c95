#pragma once
// The inner loops of the winding field: sums over collected sources, in float. Eight sums are
// computed in parallel and added in a fixed order, only with operations that IEEE 754 rounds
// exactly. So a processor with wider registers gives the same bits.

#include <array>
#include <cstddef>
#include <vector>

namespace dsc::cloud {

/// Number of parallel sums.
inline constexpr std::size_t winding_lanes = 8;
/// Number of values per source.
inline constexpr std::size_t winding_quantities = 7;

/// Sources of one group of targets, one array per quantity: position, half the squared smoothing
/// length, and a vector. Sums of scalars use only the first component of the vector.
class WindingSources {
public:
    /// Allocates `count` sources, to be written to `column(q)[0..count-1]`, and adds sources of
    /// zero strength up to a complete number of lanes.
    void resize(std::size_t count);
    std::size_t count() const { return count_; }
    float* column(std::size_t quantity) { return values_.data() + quantity * stride_; }
    const float* operator[](std::size_t quantity) const {
        return values_.data() + quantity * stride_;
    }

private:
    std::vector<float> values_;  ///< columns, one after the other
    std::size_t stride_ = 0;     ///< from one column to the next
    std::size_t count_ = 0;
};

/// One target.
struct WindingTarget {
    float x = 0.0F, y = 0.0F, z = 0.0F;
    float half_square = 0.0F;  ///< half its squared smoothing length
};

// Let d = source - target and rho^2 = d^2 + both half squares. The caller multiplies by 1 / (4 pi).

/// Sum of (vector . d) / rho^3. [parallel]
float sum_winding(const WindingSources& sources, const WindingTarget& target);
/// Sum of -scalar d / rho^3: the effect of each source, as a place with a wanted winding number, on
/// the target's vector. [parallel]
std::array<float, 3> sum_adjoint(const WindingSources& sources, const WindingTarget& target);
/// Sum of vector / rho^3 - 3 (vector . d) d / rho^5. [parallel]
std::array<float, 3> sum_gradient(const WindingSources& sources, const WindingTarget& target);

}  // namespace dsc::cloud
