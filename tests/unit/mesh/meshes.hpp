#pragma once
// Small start meshes made in code, grouped by what they are good for.

#include <functional>

#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::test {

/// A box [-h, h]^3 of n^3 cells, five tets each, pattern by the parity of i + j + k; the label of a
/// tet is that of its centroid.
inline mesh::TetMesh grid(int n, double h, const std::function<mesh::Label(const Vec3&)>& label) {
    mesh::TetMesh m;
    const auto at = [n](int i, int j, int k) {
        return static_cast<std::uint32_t>(i + (n + 1) * (j + (n + 1) * k));
    };
    for (int k = 0; k <= n; ++k) {
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i)
                m.points.push_back(
                    Vec3(-h + 2 * h * i / n, -h + 2 * h * j / n, -h + 2 * h * k / n));
        }
    }
    // Corner bits x + 2 y + 4 z of the four corner tets (apex first) and of the central one.
    constexpr int even[5][4] = {
        {4, 0, 5, 6}, {2, 0, 6, 3}, {1, 0, 3, 5}, {7, 5, 6, 3}, {0, 6, 3, 5}};
    constexpr int odd[5][4] = {
        {0, 4, 1, 2}, {3, 2, 1, 7}, {6, 2, 7, 4}, {5, 4, 7, 1}, {4, 1, 2, 7}};
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                for (int t = 0; t < 5; ++t) {
                    const auto& row = (i + j + k) % 2 == 0 ? even[t] : odd[t];
                    std::array<std::uint32_t, 4> tet{};
                    Vec3 centroid = Vec3::Zero();
                    for (unsigned c = 0; c < 4; ++c) {
                        tet[c] =
                            at(i + (row[c] & 1), j + ((row[c] >> 1) & 1), k + ((row[c] >> 2) & 1));
                        centroid += 0.25 * m.points[tet[c]];
                    }
                    m.tets.push_back(tet);
                    m.labels.push_back(label(centroid));
                }
            }
        }
    }
    return m;
}

inline mesh::TetMesh cube_grid(int n = 6) {
    return grid(n, 1.5, [](const Vec3& c) { return c.cwiseAbs().maxCoeff() < 1.0 ? 1 : 0; });
}
inline mesh::TetMesh ball_grid(int n = 10, double radius = 1.0) {
    return grid(n, 1.5, [radius](const Vec3& c) { return c.norm() < radius ? 1 : 0; });
}
inline mesh::TetMesh torus_grid(int n = 14) {
    return grid(n, 1.5, [](const Vec3& c) {
        return std::hypot(std::hypot(c.x(), c.y()) - 0.8, c.z()) < 0.35 ? 1 : 0;
    });
}
inline mesh::TetMesh two_balls_grid(int n = 12) {
    return grid(n, 1.5, [](const Vec3& c) {
        return std::min((c - Vec3(-0.6, 0, 0)).norm(), (c - Vec3(0.6, 0, 0)).norm()) < 0.5 ? 1 : 0;
    });
}
inline mesh::TetMesh three_phase_grid(int n = 10) {
    return grid(n, 1.5, [](const Vec3& c) { return c.norm() >= 1.0 ? 0 : c.x() < 0 ? 1 : 2; });
}
inline mesh::TetMesh shell_grid(int n = 14) {
    return grid(n, 1.5, [](const Vec3& c) { return c.norm() < 1.1 && c.norm() > 0.55 ? 1 : 0; });
}

}  // namespace dsc::test
