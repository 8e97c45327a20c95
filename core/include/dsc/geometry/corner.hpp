#pragma once
// Contributions of one corner of a triangle to the differential geometry of a surface.

#include <cmath>

#include <dsc/geometry/vec.hpp>

namespace dsc::geometry {

/// Angle at `a` of triangle abc, in [0, pi]; 0 if an edge at `a` has length 0. [parallel]
inline double corner_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::atan2((b - a).cross(c - a).norm(), (b - a).dot(c - a));
}

/// Cotangent of the angle at `a`, limited to +-`limit` so that a degenerate triangle has a large
/// but finite weight; 0 if an edge at `a` has length 0. [parallel]
inline double corner_cotangent(const Vec3& a, const Vec3& b, const Vec3& c, double limit) {
    const double cosine = (b - a).dot(c - a);
    const double sine = (b - a).cross(c - a).norm();
    if (sine * limit > std::abs(cosine)) return cosine / sine;
    return cosine > 0 ? limit : cosine < 0 ? -limit : 0.0;
}

/// The part of the area of triangle abc that belongs to `a` [Meyer2003]: the Voronoi cell if the
/// triangle is acute; half of the area if the obtuse angle is at `a`; else a quarter of the area.
/// The three parts of a triangle add up to its area. [parallel]
inline double mixed_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = 0.5 * (b - a).cross(c - a).norm();
    if ((b - a).dot(c - a) <= 0) return 0.5 * area;
    if ((a - b).dot(c - b) <= 0 || (a - c).dot(b - c) <= 0) return 0.25 * area;
    const double cot_b = (a - b).dot(c - b) / (2 * area);
    const double cot_c = (a - c).dot(b - c) / (2 * area);
    return ((b - a).squaredNorm() * cot_c + (c - a).squaredNorm() * cot_b) / 8;
}

}  // namespace dsc::geometry
