#pragma once
// Meshes with known properties for the tests.

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface::test {

using Index = std::uint32_t;

/// Axis-parallel cube of 12 faces looking outwards.
inline TriangleMesh cube(const Vec3& centre = Vec3::Zero(), double half = 1.0) {
    TriangleMesh m;
    for (int i = 0; i < 8; ++i) {
        m.points.push_back(centre + half * Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1,
                                                (i & 4) != 0 ? 1 : -1));
    }
    m.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
               {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return m;
}

/// Octahedron, each face split in four `levels` times and put on the sphere.
inline TriangleMesh sphere(int levels, double radius = 1.0, const Vec3& centre = Vec3::Zero()) {
    TriangleMesh m;
    m.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    m.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
               {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<Index, Index>, Index> middles;
        const auto middle = [&](Index a, Index b) {
            const auto [entry, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                            static_cast<Index>(m.points.size()));
            if (fresh) m.points.push_back((m.points[a] + m.points[b]).normalized());
            return entry->second;
        };
        std::vector<std::array<Index, 3>> finer;
        for (const auto& [a, b, c] : m.faces) {
            const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        m.faces = finer;
    }
    for (Vec3& p : m.points) p = centre + radius * p;
    return m;
}

/// Torus round the z axis of 2 n m faces.
inline TriangleMesh torus(int n = 24, int m = 12, double big = 1.0, double small = 0.4) {
    TriangleMesh out;
    const auto index = [&](int i, int j) { return static_cast<Index>((i % n) * m + j % m); };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
            const double r = big + small * std::cos(v);
            out.points.emplace_back(r * std::cos(u), r * std::sin(u), small * std::sin(v));
            out.faces.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            out.faces.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    }
    return out;
}

inline void append(TriangleMesh& to, const TriangleMesh& from) {
    const auto offset = static_cast<Index>(to.points.size());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    for (const auto& [a, b, c] : from.faces)
        to.faces.push_back({a + offset, b + offset, c + offset});
}

inline TriangleMesh inside_out(TriangleMesh m) {
    for (auto& f : m.faces) std::swap(f[1], f[2]);
    return m;
}

}  // namespace dsc::surface::test
