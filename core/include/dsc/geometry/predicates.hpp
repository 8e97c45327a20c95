#pragma once
// Exact geometric predicates on doubles: a floating filter decides most cases, exact arithmetic
// decides the rest.

#include <cstdint>

#include <dsc/geometry/vec.hpp>

namespace dsc::geometry {

/// Sign (-1, 0, 1) of det[b-a, c-a, d-a], exact for all finite doubles without overflow: 1 when d
/// lies on the side of triangle abc to which its right-hand normal points. A tet (a,b,c,d) is
/// positive when this is 1.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Sign of the 2-D determinant [b-a, c-a] of the points' coordinates (axis0, axis1), exact.
int orient2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis0, int axis1);

/// Number of orient3d calls of this thread that needed exact arithmetic.
std::uint64_t exact_fallbacks() noexcept;

}  // namespace dsc::geometry
