#include "features.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/surface/measure.hpp>

namespace dsc::strategies::from_surface {
namespace {

using Edge = std::array<std::uint32_t, 2>;

struct FaceSide {
    Edge edge;
    std::size_t face;
};

std::vector<Edge> sharp_edges(const surface::TriangleMesh& mesh, double angle) {
    const std::vector<Vec3> normals = surface::face_normals(mesh);
    std::vector<FaceSide> sides;
    sides.reserve(3 * mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
            sides.push_back({{std::min(a, b), std::max(a, b)}, f});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const FaceSide& x, const FaceSide& y) {
        return x.edge != y.edge ? x.edge < y.edge : x.face < y.face;
    });
    std::vector<Edge> edges;
    for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
        const Vec3 &m = normals[sides[i].face], &n = normals[sides[i + 1].face];
        if (m.dot(n) < std::cos(angle)) edges.push_back(sides[i].edge);
    }
    return edges;
}

}  // namespace

Features::Features(const surface::TriangleMesh& mesh, double angle) {
    const std::vector<Edge> edges = sharp_edges(mesh, angle);
    if (edges.empty()) return;
    std::vector<std::vector<std::uint32_t>> ends(mesh.points.size());
    surface::TriangleMesh lines{mesh.points, {}};
    for (const auto& [a, b] : edges) {
        ends[a].push_back(b);
        ends[b].push_back(a);
        lines.faces.push_back({a, b, b});  // a triangle without area is the union of its sides
    }
    for (std::size_t v = 0; v < ends.size(); ++v) {
        if (ends[v].empty()) continue;
        const Vec3& p = mesh.points[v];
        const bool straight =
            ends[v].size() == 2 &&
            (mesh.points[ends[v][0]] - p)
                    .normalized()
                    .dot((p - mesh.points[ends[v][1]]).normalized()) >= std::cos(angle);
        if (!straight) corners_.push_back(p);
    }
    edges_.emplace(lines);
}

bool Features::corner(const Vec3& p) const {
    return std::find(corners_.begin(), corners_.end(), p) != corners_.end();
}

}  // namespace dsc::strategies::from_surface
