#include "mesh/unpinch.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/local_star.hpp>

namespace dsc::mesh {
namespace {

constexpr double quality_floor = 1e-3;

// One face-connected group of a label in the star of the vertex.
struct Group {
    std::vector<TetId> tets;
    double volume = 0.0;
    bool on_box = false;
};

// A face (v, a, b) between a tet of the group and another: the new tet (v, v', a, b) takes `across`.
struct RimFace {
    VertexId a, b;  // (v, a, b) is counter-clockwise seen from outside the group
    Label across;
};

std::vector<Group> groups_of(const Complex& c, LocalStar& star) {
    std::vector<Group> groups(star.groups());
    for (std::size_t i = 0; i < star.nodes().size(); ++i) {
        Group& group = groups[star.group_of()[i]];
        const TetId t = star.nodes()[i];
        if (t == none) {
            group.on_box = true;
            continue;
        }
        group.tets.push_back(t);
        group.volume += c.volume(t);
    }
    // Smallest first; equal ones in the order of their first tet, which the star's walk fixes.
    std::stable_sort(groups.begin(), groups.end(), [](const Group& x, const Group& y) {
        return x.tets.size() != y.tets.size() ? x.tets.size() < y.tets.size() : x.volume < y.volume;
    });
    return groups;
}

// The rim of the group in cyclic order; empty when the group is not a disc in the vertex' link (its rim is not one
// closed cycle that visits no link vertex twice).
std::vector<RimFace> rim_of(const Complex& c, VertexId v, const Group& group) {
    std::vector<RimFace> faces;
    for (const TetId t : group.tets) {
        const Tet& tet = c.tet(t);
        for (unsigned f = 0; f < 4; ++f) {
            if (tet.v[f] == v || !c.interface_face(t, f)) continue;
            std::array<VertexId, 3> corners{};
            for (unsigned k = 0; k < 3; ++k) corners[k] = tet.v[face_vertices[f][k]];
            while (corners[0] != v) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            faces.push_back({corners[1], corners[2], c.label_across(t, f)});
        }
    }
    std::vector<RimFace> cycle;
    if (faces.empty()) return cycle;
    cycle.push_back(faces.front());
    while (cycle.size() < faces.size()) {
        const auto next = std::find_if(faces.begin(), faces.end(), [&](const RimFace& face) { return face.a == cycle.back().b; });
        if (next == faces.end() || next->a == cycle.front().a) break;
        cycle.push_back(*next);
    }
    if (cycle.size() != faces.size() || cycle.back().b != cycle.front().a) cycle.clear();
    return cycle;
}

// The direction that maximises the least distance to the planes with the given unit normals: the optimum of this small
// linear program on the unit sphere is bounded by one, two or three planes. Zero when no direction has a positive one.
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

float least_quality(const Complex& c, const Edit& edit, bool& positive) {
    float least = 1.0F;
    positive = true;
    const auto at = [&](VertexId v) -> const Vec3& { return v == created_vertex ? edit.created_at : c.position(v); };
    for (const NewTet& t : edit.added) {
        const Vec3 &p = at(t.v[0]), &q = at(t.v[1]), &r = at(t.v[2]), &s = at(t.v[3]);
        if (geometry::orient3d(p, q, r, s) != 1) {
            positive = false;
            return 0.0F;
        }
        least = std::min(least, static_cast<float>(geometry::tet_quality(p, q, r, s)));
    }
    return least;
}

// Gives the group a vertex of its own. The label of each new tet is the one across its rim face.
bool split_vertex(Complex& c, VertexId v, const Group& group, const std::vector<RimFace>& rim) {
    const Vec3& p = c.position(v);
    std::vector<Vec3> inward;
    double shortest = INFINITY;
    for (const RimFace& face : rim) {
        inward.push_back(-geometry::triangle_normal(p, c.position(face.a), c.position(face.b)));
        shortest = std::min(shortest, (c.position(face.a) - p).norm());
    }
    for (const TetId t : group.tets) {
        for (const VertexId w : c.tet(t).v) {
            if (w != v) shortest = std::min(shortest, (c.position(w) - p).norm());
        }
    }
    const Vec3 direction = deepest_direction(inward);
    if (direction.isZero()) return false;
    Edit edit;
    edit.removed = group.tets;
    edit.creates = true;
    double old_least = 1.0;
    for (const TetId t : group.tets) {
        NewTet tet{c.tet(t).v, c.label(t)};
        std::replace(tet.v.begin(), tet.v.end(), v, created_vertex);
        edit.added.push_back(tet);
        old_least = std::min(old_least, static_cast<double>(c.quality(t)));
    }
    // The rim face (v, a, b) looks out of the group, so v' lies behind it.
    for (const RimFace& face : rim) edit.added.push_back({{v, face.b, face.a, created_vertex}, face.across});
    const double floor = std::min(quality_floor, old_least);
    double t = 0.3 * shortest;
    for (int halving = 0; halving < 20; ++halving, t *= 0.5) {
        edit.created_at = p + t * direction;
        bool positive = false;
        const double least = least_quality(c, edit, positive);
        if (!positive || least < floor) continue;
        if (!c.link(edit)) return false;
        c.replace(edit);
        return true;
    }
    return false;
}

bool relabel_group(Complex& c, const Group& group, const std::vector<RimFace>& rim, VertexId v) {
    if (group.on_box || group.tets.empty()) return false;
    for (const TetId t : group.tets) {
        for (const VertexId w : c.tet(t).v) {
            if (c.on_box(w)) return false;
        }
    }
    Label around = 0;
    bool known = false;
    for (const RimFace& face : rim) {
        if (known && face.across != around) return false;
        around = face.across;
        known = true;
    }
    if (!known) {
        for (const TetId t : group.tets) {
            for (unsigned f = 0; f < 4; ++f) {
                if (c.tet(t).v[f] == v || !c.interface_face(t, f)) continue;
                around = c.label_across(t, f);
                known = true;
            }
        }
    }
    if (!known) return false;
    c.relabel(group.tets, around);
    return true;
}

[[noreturn]] void refuse(const Complex& c, VertexId v, LocalStar& star, std::string_view name) {
    std::vector<Label> labels;
    for (std::size_t i = 0; i < star.nodes().size(); ++i) labels.push_back(star.label(i));
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    std::string list;
    for (const Label l : labels) list += (list.empty() ? "" : ", ") + std::to_string(l);
    char place[96];
    std::snprintf(place, sizeof place, "(%.6g, %.6g, %.6g)", c.position(v).x(), c.position(v).y(), c.position(v).z());
    throw GeometryError("mesh.pinched", std::string(name) + ": labels " + list + " touch at vertex " + std::to_string(v) + " " +
                                            place + " in a way that cannot be pulled apart; relabel the tets there");
}

}  // namespace

std::size_t unpinch(Complex& c, std::string_view name, std::span<const VertexId> seeds) {
    std::vector<VertexId> queue(seeds.begin(), seeds.end());
    LocalStar star(c);
    std::size_t treated = 0;
    // Each split takes one group away from a vertex; relabelling may hand a problem on, hence the bound.
    std::size_t budget = 64 * (queue.size() + 16);
    for (std::size_t i = 0; i < queue.size(); ++i) {
        const VertexId v = queue[i];
        bool counted = false;
        while (c.vertex_alive(v) && c.on_interface(v)) {
            star.build(v);
            if (star.regular()) break;
            if (budget-- == 0) refuse(c, v, star, name);
            treated += counted ? 0 : 1;
            counted = true;
            const std::vector<Group> groups = groups_of(c, star);
            std::vector<VertexId> link;
            for (const TetId t : star.nodes()) {
                if (t != none) link.insert(link.end(), c.tet(t).v.begin(), c.tet(t).v.end());
            }
            bool done = false;
            for (const Group& group : groups) {
                if (done || group.on_box) continue;
                const std::vector<RimFace> rim = rim_of(c, v, group);
                done = !rim.empty() && split_vertex(c, v, group, rim);
            }
            for (const Group& group : groups) {
                if (done) break;
                done = relabel_group(c, group, rim_of(c, v, group), v);
            }
            if (!done) refuse(c, v, star, name);
            std::sort(link.begin(), link.end());
            link.erase(std::unique(link.begin(), link.end()), link.end());
            for (const VertexId w : link) {
                if (w == v || !c.vertex_alive(w) || !c.on_interface(w)) continue;
                star.build(w);
                if (!star.regular()) queue.push_back(w);
            }
        }
    }
    return treated;
}

std::size_t unpinch(Complex& c, std::string_view name) {
    std::vector<VertexId> irregular;
    LocalStar star(c);
    for (const VertexId v : c.interface_vertices()) {
        star.build(v);
        if (!star.regular()) irregular.push_back(v);
    }
    std::sort(irregular.begin(), irregular.end(), [&c](VertexId a, VertexId b) { return c.birth(a) < c.birth(b); });
    return unpinch(c, name, irregular);
}

}  // namespace dsc::mesh
