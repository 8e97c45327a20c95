#include "deviation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <dsc/base/workers.hpp>

namespace dsc::strategies::from_surface {
namespace {

constexpr std::size_t block = 256;
constexpr double most_halves = 4096;  // largest number of halves of the longest side of a triangle

struct Farthest {
    double distance = 0;
    Vec3 point = Vec3::Zero();
    void meet(const Vec3& p, double away) {
        if (away > distance) *this = {away, p};
    }
};

/// The point of a triangle that is farthest from `tree`, among the points of a grid with the
/// corners and the middles of the sides.
template <class Tree>
Farthest of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double spacing,
                     const Tree& tree) {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n =
        2 * static_cast<int>(std::clamp(std::ceil(0.5 * longest / spacing), 1.0, most_halves));
    Farthest farthest;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
            const Vec3 p =
                a + (b - a) * (static_cast<double>(i) / n) + (c - a) * (static_cast<double>(j) / n);
            farthest.meet(p, tree.nearest(p).distance);
        }
    }
    return farthest;
}

template <class Tree>
Farthest farthest_from(const Tree& tree, const surface::TriangleMesh& mesh, double spacing,
                       Workers* workers) {
    std::vector<Farthest> of_face(mesh.faces.size());
    for_blocks(workers, mesh.faces.size(), block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            const auto& [a, b, c] = mesh.faces[f];
            of_face[f] = of_triangle(mesh.points[a], mesh.points[b], mesh.points[c], spacing, tree);
        }
    });
    Farthest farthest;
    for (const Farthest& f : of_face) farthest.meet(f.point, f.distance);
    return farthest;
}

}  // namespace

Deviation deviation(const surface::TriangleMesh& interface, const Solid& solid, double spacing,
                    Workers* workers) {
    Deviation out;
    for (const Vec3& p : interface.points)
        out.of_vertices = std::max(out.of_vertices, solid.nearest(p).distance);
    const Farthest there = farthest_from(solid, interface, spacing, workers);
    const Farthest back =
        farthest_from(surface::TriangleTree(interface), solid.surface(), spacing, workers);
    out.of_interface = there.distance;
    out.of_surface = back.distance;
    out.farthest = back.distance > there.distance ? back.point : there.point;
    return out;
}

}  // namespace dsc::strategies::from_surface
