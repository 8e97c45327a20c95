// Sizes, closest points and distances of triangles and segments.
#include "dsc/geometry/quality.hpp"

#include <algorithm>

namespace dsc::geometry {

Vec3 triangle_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = (b - a).cross(c - a);
    const double length = n.norm();
    return length > 0.0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

Vec3 closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const Vec3 bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
        return d1 - d3 > 0.0 ? Vec3(a + (d1 / (d1 - d3)) * ab) : a;
    const Vec3 cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
        return d2 - d6 > 0.0 ? Vec3(a + (d2 / (d2 - d6)) * ac) : a;
    const double va = d3 * d6 - d5 * d4;
    const double along = d4 - d3, back = d5 - d6;
    if (va <= 0.0 && along >= 0.0 && back >= 0.0) {
        return along + back > 0.0 ? Vec3(b + (along / (along + back)) * (c - b)) : b;
    }
    const double total = va + vb + vc;
    return a + ab * (vb / total) + ac * (vc / total);
}

double segment_distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = d - c, w = a - c;
    const double uu = u.squaredNorm(), vv = v.squaredNorm(), vw = v.dot(w);
    double s = 0.0;
    double t = 0.0;
    if (uu <= 0.0) {
        t = vv > 0.0 ? std::clamp(vw / vv, 0.0, 1.0) : 0.0;
    } else {
        const double uw = u.dot(w);
        if (vv <= 0.0) {
            s = std::clamp(-uw / uu, 0.0, 1.0);
        } else {
            const double uv = u.dot(v);
            const double det = uu * vv - uv * uv;
            s = det > 0.0 ? std::clamp((uv * vw - uw * vv) / det, 0.0, 1.0) : 0.0;
            t = (uv * s + vw) / vv;
            if (t < 0.0 || t > 1.0) {
                t = std::clamp(t, 0.0, 1.0);
                s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
            }
        }
    }
    return (a + s * u - c - t * v).norm();
}

}  // namespace dsc::geometry
