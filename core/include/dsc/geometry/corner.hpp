#pragma once
// What one corner of a triangle contributes to the differential geometry of a surface.

#include <algorithm>
#include <cmath>
#include <dsc/geometry/vec.hpp>

namespace dsc::geometry {

/// Angle at `a` of triangle abc, in [0, pi]; 0 where an edge at `a` has no length. [parallel]
inline double corner_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::atan2((b - a).cross(c - a).norm(), (b - a).dot(c - a));
}

/// Cotangent of the angle at `a`, held within +-`limit` so that a degenerate triangle weighs much but not
/// infinitely; 0 where an edge at `a` has no length. [parallel]
inline double corner_cotangent(const Vec3& a, const Vec3& b, const Vec3& c, double limit) {
    const double cosine = (b - a).dot(c - a);
    const double sine = (b - a).cross(c - a).norm();
    if (sine * limit > std::abs(cosine)) return cosine / sine;
    return cosine > 0 ? limit : cosine < 0 ? -limit : 0.0;
}

/// The part of triangle abc that belongs to `a`: its Voronoi cell where the triangle is acute, else half of
/// the triangle where the obtuse angle is at `a`, a quarter where it is not [Meyer2003]. The three parts of a
/// triangle add up to its area. [parallel]
inline double mixed_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = 0.5 * (b - a).cross(c - a).norm();
    if ((b - a).dot(c - a) <= 0) return 0.5 * area;
    if ((a - b).dot(c - b) <= 0 || (a - c).dot(b - c) <= 0) return 0.25 * area;
    const double cot_b = (a - b).dot(c - b) / (2 * area);
    const double cot_c = (a - c).dot(b - c) / (2 * area);
    return ((b - a).squaredNorm() * cot_c + (c - a).squaredNorm() * cot_b) / 8;
}

}  // namespace dsc::geometry
