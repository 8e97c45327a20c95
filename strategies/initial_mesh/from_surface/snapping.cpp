#include "snapping.hpp"

#include <algorithm>

#include <dsc/mesh/star_quality.hpp>

namespace dsc::strategies::from_surface {
namespace {

/// After about forty rounds, vertices that are stuck begin to slide and stretch the triangles
/// around them.
constexpr unsigned rounds = 40;
/// Further rounds, in which the vertices that have not arrived continue at the cost of shape.
constexpr unsigned last_rounds = 20;
constexpr double last_quality = 0.08;
/// In finest cells: vertices nearer than this to a sharp edge move onto it; each corner takes the
/// nearest vertex within its reach.
constexpr double edge_reach = 0.35, corner_reach = 1.5;
constexpr double least_quality = 0.05;

/// The movable interface vertex within reach of the corner whose tets keep the best shape when it
/// moves there; none if the tets of all would be bad.
mesh::VertexId best_for(const mesh::Complex& c, const Vec3& corner, double reach,
                        std::vector<mesh::TetId>& star) {
    mesh::VertexId best = mesh::none;
    double best_quality = least_quality;
    for (const mesh::VertexId v : c.interface_vertices()) {
        if (!c.movable(v) || (c.position(v) - corner).norm() > reach) continue;
        c.star(v, star);
        const double quality = mesh::star_quality(c, star, v, corner);
        const bool older = best != mesh::none && c.birth(v) < c.birth(best);
        if (quality < best_quality || (quality == best_quality && !older)) continue;
        best = v;
        best_quality = quality;
    }
    return best;
}

/// Moves a vertex to each corner that a vertex can reach; returns these vertices.
std::vector<mesh::VertexId> take_corners(mesh::Complex& c, const std::vector<Vec3>& corners,
                                         double reach) {
    std::vector<mesh::VertexId> taken;
    std::vector<mesh::TetId> star;
    for (const Vec3& corner : corners) {
        const mesh::VertexId v = best_for(c, corner, reach, star);
        if (v == mesh::none || std::find(taken.begin(), taken.end(), v) != taken.end()) continue;
        c.star(v, star);
        c.move(v, corner, star);
        taken.push_back(v);
    }
    return taken;
}

}  // namespace

generate::ProjectReport snap(mesh::Complex& complex, const Solid& solid, const Features& features,
                             double cell) {
    const auto nearest = [&](const Vec3& p) {
        if (!features.empty()) {
            const surface::NearestHit edge = features.nearest(p);
            if (edge.distance <= edge_reach * cell) return edge.point;
        }
        return solid.nearest(p).point;
    };
    generate::ProjectOptions options;
    options.rounds = rounds;
    generate::project_interface(complex, nearest, options);
    options.fixed = take_corners(complex, features.corners(), corner_reach * cell);
    options.quality = last_quality;
    options.rounds = last_rounds;
    return generate::project_interface(complex, nearest, options);
}

}  // namespace dsc::strategies::from_surface
