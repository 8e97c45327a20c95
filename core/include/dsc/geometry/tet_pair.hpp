#pragma once
// Computations for two tets side by side, which the processor performs at the same time. The
// results have the bits of the functions for one tet.

#include <array>

#include <dsc/geometry/vec.hpp>

namespace dsc::geometry {

/// A number of each of the two tets.
using Two = Eigen::Array2d;
/// A vector of each: the two x, the two y, the two z.
using TwoVec3 = std::array<Two, 3>;

inline TwoVec3 side_by_side(const Vec3& first, const Vec3& second) {
    return {Two(first[0], second[0]), Two(first[1], second[1]), Two(first[2], second[2])};
}
inline TwoVec3 difference(const TwoVec3& to, const TwoVec3& from) {
    return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}
/// The sum has the order of Eigen's sums over a vector of three.
inline Two dot(const TwoVec3& x, const TwoVec3& y) {
    return (x[0] * y[0] + x[1] * y[1]) + x[2] * y[2];
}
inline TwoVec3 cross(const TwoVec3& x, const TwoVec3& y) {
    return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// Quality and mean squared edge of both tets.
struct TwoShapes {
    Two quality;
    Two mean_square;
};

/// tet_shape() of both tets; `corners` are the four corners in their order. Always inline, because
/// the corners would go through the memory otherwise.
[[gnu::always_inline]] inline TwoShapes tet_shapes(const std::array<TwoVec3, 4>& corners) {
    const auto& [a, b, c, d] = corners;
    const TwoVec3 ab = difference(b, a), ac = difference(c, a), ad = difference(d, a);
    const TwoVec3 bc = difference(c, b), bd = difference(d, b), cd = difference(d, c);
    const Two mean_square =
        (dot(ab, ab) + dot(ac, ac) + dot(ad, ad) + dot(bc, bc) + dot(bd, bd) + dot(cd, cd)) / 6.0;
    const Two value =
        1.4142135623730951 * dot(cross(ab, ac), ad) / (mean_square * mean_square.sqrt());
    return {(mean_square > 0.0).select(value, Two::Zero()), mean_square};
}

}  // namespace dsc::geometry
