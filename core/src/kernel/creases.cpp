// The rule for creases: compares the faces and edges before and after a change (method.md,
// section 4.10).
#include "kernel/creases.hpp"

#include <dsc/geometry/quality.hpp>

namespace dsc::kernel {

// The faces before and after a change, and the inner edges of each set.
struct CreaseScratch {
    // An interface face: its corners, counter-clockwise seen from the smaller label, and its unit
    // normal.
    struct Face {
        std::array<VertexId, 3> v;
        Vec3 normal;
    };
    // An edge between two faces of one list, with the cosine between their normals.
    struct Edge {
        VertexId a, b;  // ascending
        double cosine;
        bool operator<(const Edge& other) const { return a != other.a ? a < other.a : b < other.b; }
    };
    struct Side {
        VertexId a, b;
        std::uint32_t face;
    };
    std::vector<Face> before, after;
    std::vector<Edge> edges_before, edges_after;
    std::vector<Side> sides;  // of the faces of one list
};

namespace {

using Face = CreaseScratch::Face;
using CreaseEdge = CreaseScratch::Edge;
using Patches = CreaseScratch;

Patches& emptied_patches(Workbench& bench) {
    Patches& patches = bench.creases.get();
    patches.before.clear();
    patches.after.clear();
    return patches;
}

template <class At>
Face make_face(const std::array<VertexId, 4>& tet, unsigned f, const At& at) {
    Face face{};
    for (unsigned k = 0; k < 3; ++k) face.v[k] = tet[mesh::face_vertices[f][k]];
    face.normal = geometry::triangle_normal(at(face.v[0]), at(face.v[1]), at(face.v[2]));
    return face;
}

// Edges with three faces or more, where three labels meet, are left out.
void find_edges(const std::vector<Face>& faces, std::vector<CreaseScratch::Side>& sides,
                std::vector<CreaseEdge>& out) {
    sides.clear();
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        for (unsigned k = 0; k < 3; ++k) {
            const VertexId a = faces[f].v[k], b = faces[f].v[(k + 1) % 3];
            sides.push_back({std::min(a, b), std::max(a, b), f});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const auto& x, const auto& y) {
        return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.face < y.face;
    });
    out.clear();
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].a == sides[i].a && sides[end].b == sides[i].b)
            ++end;
        if (end - i == 2)
            out.push_back({sides[i].a, sides[i].b,
                           faces[sides[i].face].normal.dot(faces[sides[i + 1].face].normal)});
        i = end;
    }
}

bool is_crease(const std::vector<CreaseEdge>& edges, VertexId a, VertexId b, double cosine) {
    const CreaseEdge wanted{std::min(a, b), std::max(a, b), 0.0};
    const auto found = std::lower_bound(edges.begin(), edges.end(), wanted);
    return found != edges.end() && found->a == wanted.a && found->b == wanted.b &&
           found->cosine < cosine;
}

// A face that keeps its place, apart from the name of a corner, is compared with itself; other
// faces with the nearest old face.
bool turns_too_far(const Patches& p, VertexId kept, VertexId removed, double turn) {
    const auto sorted = [&](std::array<VertexId, 3> v) {
        std::replace(v.begin(), v.end(), removed, kept);
        std::sort(v.begin(), v.end());
        return v;
    };
    for (const Face& face : p.after) {
        double nearest = -1.0;
        for (const Face& old : p.before) {
            const double cosine = old.normal.dot(face.normal);
            if (removed != mesh::none && sorted(old.v) == sorted(face.v)) {
                nearest = cosine;
                break;
            }
            nearest = std::max(nearest, cosine);
        }
        if (nearest < turn) return true;
    }
    return false;
}

std::size_t creases_at(const Patches& p, VertexId v, double crease) {
    return static_cast<std::size_t>(std::count_if(
        p.edges_before.begin(), p.edges_before.end(),
        [&](const CreaseEdge& e) { return e.cosine < crease && (e.a == v || e.b == v); }));
}

// A vertex on a crease may only move along it, and not if it is an end or a corner of the crease.
bool leaves_crease(const Patches& p, VertexId kept, VertexId removed, bool kept_moves,
                   double crease) {
    const bool along = is_crease(p.edges_before, kept, removed, crease);
    const auto stays_on = [along](std::size_t creases) {
        return creases == 0 ? !along : along && creases == 2;
    };
    return !stays_on(creases_at(p, removed, crease)) ||
           (kept_moves && !stays_on(creases_at(p, kept, crease)));
}

bool loses_crease(const Patches& p, VertexId kept, VertexId removed, double crease) {
    for (const CreaseEdge& e : p.edges_before) {
        if (!(e.cosine < crease)) continue;
        const VertexId a = e.a == removed ? kept : e.a, b = e.b == removed ? kept : e.b;
        if (a == b) continue;  // the crease is collapsed along itself
        if (!is_crease(p.edges_after, a, b, crease)) return true;
    }
    return false;
}

// If the cavity has a nearly flat tet, the rule does not apply.
Outcome check_patches(Workbench& bench, Patches& p, VertexId kept, VertexId removed, float worst) {
    find_edges(p.before, p.sides, p.edges_before);
    find_edges(p.after, p.sides, p.edges_after);
    const Limits& limits = bench.limits;
    const bool leaves = removed != mesh::none &&
                        leaves_crease(p, kept, removed, bench.edit.moved == kept, limits.crease);
    if (!leaves && !loses_crease(p, kept, removed, limits.crease) &&
        !turns_too_far(p, kept, removed, limits.turn)) {
        return success;
    }
    if (!(worst < static_cast<float>(limits.crease_floor))) return Refusal::bound;
    ++bench.crease_exceptions;
    return success;
}

}  // namespace

Outcome check_creases(Workbench& bench, VertexId kept, VertexId removed) {
    if (!bench.limits.keeps_creases()) return success;
    const mesh::Complex& c = bench.complex;
    const mesh::Edit& edit = bench.edit;
    Patches& p = emptied_patches(bench);
    const auto now = [&c](VertexId v) -> const Vec3& { return c.position(v); };
    for (const TetId t : edit.removed) {
        for (unsigned f = 0; f < 4; ++f) {
            const mesh::Label across = c.label_across(t, f);
            if (c.label(t) > across) p.before.push_back(make_face(c.tet(t).v, f, now));
            // The neighbour outside the cavity has the larger label, so the orientation of the face
            // is reversed.
            const std::uint32_t code = c.across(t, f);
            if (c.label(t) >= across || code == mesh::none) continue;
            const TetId other = mesh::neighbour_tet(code);
            if (std::find(edit.removed.begin(), edit.removed.end(), other) != edit.removed.end())
                continue;
            p.before.push_back(make_face(c.tet(other).v, mesh::neighbour_face(code), now));
        }
    }
    if (p.before.empty()) return success;
    const auto then = [&bench](VertexId v) -> const Vec3& { return bench.at(v); };
    for (std::size_t i = 0; i < edit.added.size(); ++i) {
        const mesh::NewTet& tet = edit.added[i];
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = edit.neighbours[i][f];
            const bool inside = code != mesh::none && (code & mesh::Edit::virtual_code) != 0;
            const mesh::Label across =
                code == mesh::none ? 0
                : inside           ? edit.added[(code & ~mesh::Edit::virtual_code) >> 2U].label
                                   : c.label(mesh::neighbour_tet(code));
            if (tet.label > across) p.after.push_back(make_face(tet.v, f, then));
            if (tet.label >= across || inside) continue;
            p.after.push_back(
                make_face(c.tet(mesh::neighbour_tet(code)).v, mesh::neighbour_face(code), then));
        }
    }
    return check_patches(bench, p, kept, removed, bench.old_quality());
}

Outcome check_creases(Workbench& bench, std::span<const TetId> tets, mesh::Label label) {
    if (!bench.limits.keeps_creases()) return success;
    const mesh::Complex& c = bench.complex;
    Patches& p = emptied_patches(bench);
    const auto now = [&c](VertexId v) -> const Vec3& { return c.position(v); };
    float worst = 1.0F;
    // All of them have one label; the orientation is outwards from the larger label.
    const auto add = [&](std::vector<Face>& faces, TetId t, unsigned f, mesh::Label inner,
                         mesh::Label outer) {
        if (inner == outer) return;
        Face& face = faces.emplace_back(make_face(c.tet(t).v, f, now));
        if (inner < outer) face.normal = -face.normal;
    };
    for (const TetId t : tets) {
        worst = std::min(worst, c.quality(t));
        for (unsigned f = 0; f < 4; ++f) {
            const std::uint32_t code = c.across(t, f);
            if (code != mesh::none &&
                std::find(tets.begin(), tets.end(), mesh::neighbour_tet(code)) != tets.end())
                continue;
            add(p.before, t, f, c.label(t), c.label_across(t, f));
            add(p.after, t, f, label, c.label_across(t, f));
        }
    }
    return check_patches(bench, p, mesh::none, mesh::none, worst);
}

}  // namespace dsc::kernel
