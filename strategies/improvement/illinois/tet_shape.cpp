#include "tet_shape.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/geometry/quality.hpp>

namespace dsc::improvement {
namespace {

using Pair = std::array<std::uint8_t, 2>;
constexpr std::array<Pair, 6> pairs = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

// The two numbers of 0..3 that are not in the pair.
Pair others(const Pair& pair) {
    Pair rest{};
    std::size_t n = 0;
    for (std::uint8_t i = 0; i < 4; ++i) {
        if (i != pair[0] && i != pair[1]) rest[n++] = i;
    }
    return rest;
}

double distance_from_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double length2 = along.squaredNorm();
    const double s = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (a + s * along - p).norm();
}

struct Face {
    std::array<std::uint8_t, 3> corner{};
    double area = 0.0;
};
Face face_opposite(const std::array<Vec3, 4>& p, std::uint8_t apex) {
    Face face;
    std::size_t n = 0;
    for (std::uint8_t i = 0; i < 4; ++i) {
        if (i != apex) face.corner[n++] = i;
    }
    face.area = geometry::triangle_area(p[face.corner[0]], p[face.corner[1]], p[face.corner[2]]);
    return face;
}

// Barycentric coordinates of a point's projection on the face, times twice the face's area squared.
std::array<double, 3> projection(const std::array<Vec3, 4>& p, const Face& face,
                                 const Vec3& point) {
    const Vec3 &a = p[face.corner[0]], &b = p[face.corner[1]], &c = p[face.corner[2]];
    const Vec3 normal = (b - a).cross(c - a);
    return {(b - point).cross(c - point).dot(normal), (c - point).cross(a - point).dot(normal),
            (a - point).cross(b - point).dot(normal)};
}

}  // namespace

TetShape classify(const std::array<Vec3, 4>& p, double length, const ShapeLimits& limits) {
    const auto length_of = [&](const Pair& e) { return (p[e[0]] - p[e[1]]).norm(); };
    const auto shorter = [&](const Pair& x, const Pair& y) { return length_of(x) < length_of(y); };
    const auto [shortest, longest] = std::minmax_element(pairs.begin(), pairs.end(), shorter);
    const double scale = std::min(length_of(*longest), length);
    TetShape shape;
    shape.edge = *shortest;
    shape.vertex = others(*shortest)[0];
    shape.opposite = others(*shortest)[1];
    if (!(scale > 0.0)) return shape;

    // The vertex with the least altitude is opposite the largest face.
    std::uint8_t apex = 0;
    Face base = face_opposite(p, 0);
    for (std::uint8_t i = 1; i < 4; ++i) {
        const Face face = face_opposite(p, i);
        if (face.area <= base.area) continue;
        base = face;
        apex = i;
    }
    const double volume = std::abs(geometry::tet_volume(p[0], p[1], p[2], p[3]));
    shape.altitude = base.area > 0.0 ? 3.0 * volume / base.area / scale : 0.0;
    if (length_of(*shortest) < limits.wedge * scale) return shape;

    double nearest = INFINITY;
    for (const Pair& edge : pairs) {
        const Pair rest = others(edge);
        for (const std::uint8_t v : rest) {
            const double distance = distance_from_segment(p[v], p[edge[0]], p[edge[1]]);
            if (distance >= nearest) continue;
            nearest = distance;
            shape.edge = edge;
            shape.vertex = v;
            shape.opposite = rest[0] == v ? rest[1] : rest[0];
        }
    }
    shape.flat_class = FlatClass::tee;
    if (nearest < limits.tee * scale) return shape;

    const std::array<double, 3> weight = projection(p, base, p[apex]);
    const std::size_t least =
        static_cast<std::size_t>(std::min_element(weight.begin(), weight.end()) - weight.begin());
    shape.flat_class = weight[least] < 0.0 ? FlatClass::sliver : FlatClass::cap;
    shape.vertex = apex;
    shape.opposite = base.corner[least];
    shape.edge = {base.corner[(least + 1) % 3], base.corner[(least + 2) % 3]};
    return shape;
}

}  // namespace dsc::improvement
