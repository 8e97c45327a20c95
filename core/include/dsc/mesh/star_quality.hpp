#pragma once
// What the tets round a vertex would be if the vertex were at another place (method.md,
// sections 4.2 and 5.2).

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// The corners of a tet, with v at `place`. Valid as long as the place and the complex. [parallel]
inline std::array<const Vec3*, 4> corners_at(const Complex& complex, TetId t, VertexId v,
                                             const Vec3& place) {
    std::array<const Vec3*, 4> corners{};
    const auto& ids = complex.tet(t).v;
    for (unsigned i = 0; i < 4; ++i) corners[i] = ids[i] == v ? &place : &complex.position(ids[i]);
    return corners;
}
/// The quality of the tet with these corners.
inline double quality_of(const std::array<const Vec3*, 4>& p) {
    return geometry::tet_quality(*p[0], *p[1], *p[2], *p[3]);
}
/// Whether the tet with these corners is exactly positive.
inline bool exactly_positive(const std::array<const Vec3*, 4>& p) {
    return geometry::orient3d(*p[0], *p[1], *p[2], *p[3]) == 1;
}
/// A tet above this quality is positive if its squared edges are above the second number.
inline constexpr float clear_quality = 1e-9F;
inline constexpr double no_underflow = 1e-120;
/// The same if the tet's quality is known. It nearly always decides: with m the mean squared edge,
/// the determinant is q m^(3/2) / sqrt(2), and rounding changes it by less than 1e-13 m^(3/2): by
/// 8 eps times six products of three edges, each of which is at most (6 m)^(3/2). The length
/// excludes numbers so small that they underflow.
inline bool exactly_positive(const std::array<const Vec3*, 4>& p, float quality) {
    if (quality > clear_quality && (*p[1] - *p[0]).squaredNorm() > no_underflow) return true;
    return exactly_positive(p);
}

/// The least quality of the tets if v is moved to `place`, at most 1. Returns 0 if a tet would not
/// be exactly positive. [parallel]
inline double star_quality(const Complex& complex, std::span<const TetId> star, VertexId v,
                           const Vec3& place) {
    double least = 1.0;
    for (const TetId t : star) {
        const auto corners = corners_at(complex, t, v, place);
        if (!exactly_positive(corners)) return 0.0;
        least = std::min(least, quality_of(corners));
    }
    return least;
}

/// The least quality of the tets if v is moved to `place`, without the exact test. Tets for which
/// `counts(t)` is false are left out. Returns 2 if no tet counts, and -1 if the quality of a tet is
/// at most `bound`. [parallel]
template <class Counts>
float star_quality_above(float bound, const Complex& complex, std::span<const TetId> star,
                         VertexId v, const Vec3& place, const Counts& counts) {
    float least = 2.0F;
    for (const TetId t : star) {
        if (!counts(t)) continue;
        const auto q = static_cast<float>(quality_of(corners_at(complex, t, v, place)));
        if (!(q > bound)) return -1.0F;
        least = std::min(least, q);
    }
    return least;
}

}  // namespace dsc::mesh
