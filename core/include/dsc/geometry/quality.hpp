#pragma once
// Sizes and shape measures of triangles and tets.

#include <cmath>

#include <dsc/geometry/vec.hpp>

namespace dsc::geometry {

/// Signed volume of tet (a,b,c,d), positive when orient3d is.
inline double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6.0;
}

/// Quality of a tet and the mean of its six squared edges.
struct TetShape {
    double quality;
    double mean_square;
};

/// Signed volume-length quality 6 sqrt(2) V / l_rms^3 [Parthasarathy1994]: 1 for a regular tet, 0
/// for a flat one, negative for an inverted one, 0 if all four points are equal (method.md,
/// section 1.1).
inline TetShape tet_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 ab = b - a, ac = c - a, ad = d - a;
    const double mean_square =
        (ab.squaredNorm() + ac.squaredNorm() + ad.squaredNorm() + (c - b).squaredNorm() +
         (d - b).squaredNorm() + (d - c).squaredNorm()) /
        6.0;
    if (!(mean_square > 0.0)) return {0.0, mean_square};
    // 6 sqrt(2) V with 6 V = det
    return {1.4142135623730951 * ab.cross(ac).dot(ad) / (mean_square * std::sqrt(mean_square)),
            mean_square};
}
/// The same without the edges.
inline double tet_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return tet_shape(a, b, c, d).quality;
}

/// Volume of the regular tet with the given edge length.
inline double regular_tet_volume(double edge) { return edge * edge * edge * 0.11785113019775793; }

inline double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

/// Unit normal by the right-hand rule; zero for a degenerate triangle.
Vec3 triangle_normal(const Vec3& a, const Vec3& b, const Vec3& c);

/// Point of triangle abc closest to p [Ericson2004].
Vec3 closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Least distance between the segments ab and cd [Ericson2004].
double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace dsc::geometry
