// Splits a vertex: rim of a group, direction and distance of the new vertex (method.md,
// section 4.6).
#include "dsc/mesh/vertex_split.hpp"

#include <algorithm>

#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::mesh {
namespace {

// The direction that maximises the least distance to the planes with the given unit normals. This
// is a small linear program on the unit sphere; one, two or three planes limit its optimum. Zero if
// no direction has a positive distance to all planes.
Vec3 deepest_direction(const std::vector<Vec3>& normals) {
    Vec3 best = Vec3::Zero();
    double best_depth = 1e-9;
    const auto offer = [&](const Vec3& candidate) {
        const double length = candidate.norm();
        if (!(length > 1e-12)) return;
        for (const double sign : {1.0, -1.0}) {
            const Vec3 d = candidate * (sign / length);
            double depth = 1.0;
            for (const Vec3& n : normals) depth = std::min(depth, n.dot(d));
            if (depth <= best_depth) continue;
            best_depth = depth;
            best = d;
        }
    };
    for (std::size_t i = 0; i < normals.size(); ++i) {
        offer(normals[i]);
        for (std::size_t j = i + 1; j < normals.size(); ++j) {
            offer(normals[i] + normals[j]);
            for (std::size_t k = j + 1; k < normals.size(); ++k) {
                offer((normals[i] - normals[j]).cross(normals[i] - normals[k]));
            }
        }
    }
    return best;
}

double least_quality(const Complex& c, const Edit& edit) {
    double least = 1.0;
    const auto at = [&](VertexId v) -> const Vec3& {
        return v == created_vertex ? edit.created_at : c.position(v);
    };
    for (const NewTet& t : edit.added) {
        const Vec3 &p = at(t.v[0]), &q = at(t.v[1]), &r = at(t.v[2]), &s = at(t.v[3]);
        if (geometry::orient3d(p, q, r, s) != 1) return -1.0;
        least = std::min(least, geometry::tet_quality(p, q, r, s));
    }
    return least;
}

}  // namespace

std::vector<RimFace> rim_of(const Complex& c, VertexId v, std::span<const TetId> group) {
    std::vector<RimFace> faces;
    for (const TetId t : group) {
        const Tet& tet = c.tet(t);
        for (unsigned f = 0; f < 4; ++f) {
            if (tet.v[f] == v) continue;
            const std::uint32_t code = c.across(t, f);
            if (code == none) return {};
            if (std::find(group.begin(), group.end(), neighbour_tet(code)) != group.end()) continue;
            std::array<VertexId, 3> corners{};
            for (unsigned k = 0; k < 3; ++k) corners[k] = tet.v[face_vertices[f][k]];
            while (corners[0] != v)
                std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            faces.push_back({corners[1], corners[2], c.label_across(t, f)});
        }
    }
    std::vector<RimFace> cycle;
    if (faces.empty()) return cycle;
    cycle.push_back(faces.front());
    while (cycle.size() < faces.size()) {
        const auto next = std::find_if(faces.begin(), faces.end(), [&](const RimFace& face) {
            return face.a == cycle.back().b;
        });
        if (next == faces.end() || next->a == cycle.front().a) break;
        cycle.push_back(*next);
    }
    if (cycle.size() != faces.size() || cycle.back().b != cycle.front().a) cycle.clear();
    return cycle;
}

bool plan_vertex_split(const Complex& c, VertexId v, std::span<const TetId> group,
                       std::span<const RimFace> rim, RimLabel labels, double floor, Edit& edit) {
    const Vec3 p = c.position(v);
    std::vector<Vec3> inward;
    for (const RimFace& face : rim)
        inward.push_back(-geometry::triangle_normal(p, c.position(face.a), c.position(face.b)));
    const Vec3 direction = deepest_direction(inward);
    if (direction.isZero()) return false;
    edit.clear();
    edit.removed.assign(group.begin(), group.end());
    edit.creates = true;
    double old = 1.0;
    double shortest = INFINITY;
    for (const TetId t : group) {
        NewTet tet{c.tet(t).v, c.label(t)};
        for (VertexId& w : tet.v) {
            if (w == v) {
                w = created_vertex;
            } else {
                shortest = std::min(shortest, (c.position(w) - p).norm());
            }
        }
        edit.added.push_back(tet);
        old = std::min(old, static_cast<double>(c.quality(t)));
    }
    const Label own = c.label(group.front());
    // The rim face (v, a, b) is oriented out of the group, so v' lies behind it.
    for (const RimFace& face : rim) {
        edit.added.push_back(
            {{v, face.b, face.a, created_vertex}, labels == RimLabel::across ? face.across : own});
    }
    const double bound = std::min(floor, old);
    double t = 0.3 * shortest;
    for (int halving = 0; halving < 20; ++halving, t *= 0.5) {
        edit.created_at = p + t * direction;
        if (least_quality(c, edit) >= bound) return true;
    }
    return false;
}

}  // namespace dsc::mesh
