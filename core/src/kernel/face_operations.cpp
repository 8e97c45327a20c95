// Operations at faces: multi-face removal (2-3 flips and wider), face split (method.md,
// sections 4.4 and 4.6).
#include <dsc/geometry/quality.hpp>

#include "kernel/operations.hpp"

namespace dsc::kernel {
namespace {

constexpr std::size_t max_sandwiched = 8;

// Faces between the apices `above` and `below`; the set grows over their edges as long as the
// quality does not fall.
class Sandwich {
public:
    Sandwich(Workbench& bench, VertexId above, VertexId below)
        : bench_(bench), above_(above), below_(below) {}

    // The decision about one edge (u, w) of such a face, counter-clockwise seen from `above`.
    struct Answer {
        float old;
        float now;
    };

    // tet_a contains above, u, w and the face's third vertex; tet_b the same with below.
    Answer visit(VertexId u, VertexId w, VertexId third, TetId tet_a, TetId tet_b) {
        mesh::Complex& c = bench_.complex;
        const auto without = static_cast<float>(bench_.quality(below_, above_, u, w));
        const std::uint32_t code_a = c.across(tet_a, mesh::index_of(c.tet(tet_a), third));
        const std::uint32_t code_b = c.across(tet_b, mesh::index_of(c.tet(tet_b), third));
        if (code_a != mesh::none && code_b != mesh::none &&
            bench_.edit.removed.size() < 2 * max_sandwiched) {
            const TetId next_a = mesh::neighbour_tet(code_a), next_b = mesh::neighbour_tet(code_b);
            const VertexId x = c.tet(next_a).v[mesh::neighbour_face(code_a)];
            const bool fits = x == c.tet(next_b).v[mesh::neighbour_face(code_b)] && x != above_ &&
                              x != below_ && c.label(next_a) == c.label(tet_a) &&
                              c.label(next_b) == c.label(tet_b) && !listed(next_a);
            if (fits) {
                const std::size_t removed = bench_.edit.removed.size(),
                                  added = bench_.edit.added.size();
                bench_.edit.removed.push_back(next_a);
                bench_.edit.removed.push_back(next_b);
                const float here = std::min(c.quality(next_a), c.quality(next_b));
                const Answer first = visit(u, x, w, next_a, next_b);
                const Answer second = visit(x, w, u, next_a, next_b);
                const float now = std::min(first.now, second.now);
                const float old = std::min({here, first.old, second.old});
                if (now > old || now > without) return {old, now};
                bench_.edit.removed.resize(removed);
                bench_.edit.added.resize(added);
            }
        }
        bench_.edit.added.push_back({{below_, above_, u, w}, c.label(tet_a)});
        return {1.0F, without};
    }

private:
    bool listed(TetId t) const {
        return std::find(bench_.edit.removed.begin(), bench_.edit.removed.end(), t) !=
               bench_.edit.removed.end();
    }

    Workbench& bench_;
    VertexId above_, below_;
};

}  // namespace

Outcome remove_faces(Workbench& bench, TetId t, unsigned face, float accept_above) {
    mesh::Complex& c = bench.complex;
    const std::uint32_t code = c.across(t, face);
    if (code == mesh::none) return Refusal::box;
    const TetId other = mesh::neighbour_tet(code);
    if (c.label(t) != c.label(other)) return Refusal::not_applicable;
    // Seen from inside t, its outward face order runs clockwise: from the apex (u, w, v) is
    // counter-clockwise.
    const VertexId above = c.tet(t).v[face], below = c.tet(other).v[mesh::neighbour_face(code)];
    const VertexId u = c.tet(t).v[mesh::face_vertices[face][0]];
    const VertexId v = c.tet(t).v[mesh::face_vertices[face][2]];
    const VertexId w = c.tet(t).v[mesh::face_vertices[face][1]];
    bench.edit.clear();
    bench.edit.removed = {t, other};
    Sandwich sandwich(bench, above, below);
    // A tet of negative quality is refused below in any case.
    const auto e1 = sandwich.visit(u, v, w, t, other);
    if (e1.now < 0.0F) return Refusal::quality;
    const auto e2 = sandwich.visit(v, w, u, t, other);
    if (e2.now < 0.0F) return Refusal::quality;
    const auto e3 = sandwich.visit(w, u, v, t, other);
    const float old = bench.old_quality();
    const float must_exceed = std::min(old, accept_above);
    if (!(std::min({e1.now, e2.now, e3.now}) > must_exceed)) return Refusal::quality;
    if (const Outcome o = bench.check_shape(must_exceed, old); o.refused()) return o;
    if (!c.link(bench.edit)) return Refusal::irregular;
    bench.commit();
    return success;
}

Outcome split_face(Workbench& bench, TetId t, unsigned face, const Vec3& point) {
    mesh::Complex& c = bench.complex;
    const std::uint32_t code = c.across(t, face);
    if (code == mesh::none) return Refusal::box;
    const TetId other = mesh::neighbour_tet(code);
    bench.edit.clear();
    bench.edit.removed = {t, other};
    bench.edit.creates = true;
    bench.edit.created_at = point;
    for (const TetId side : {t, other}) {
        const unsigned f = side == t ? face : mesh::neighbour_face(code);
        for (unsigned k = 0; k < 3; ++k) {
            mesh::NewTet tet{c.tet(side).v, c.label(side)};
            tet.v[mesh::face_vertices[f][k]] = mesh::created_vertex;
            bench.edit.added.push_back(tet);
        }
    }
    if (const Outcome o = bench.check_shape(0.0F, bench.old_quality()); o.refused()) return o;
    InterfaceChange change;
    if (c.label(t) != c.label(other)) {
        // The point lies in the face's plane up to rounding; otherwise the split would move the
        // interface.
        change.volume = bench.phase_change();
        if (change.exceeds(bench.bounds_at(c.tet(t).v))) return Refusal::bound;
    }
    if (!c.link(bench.edit)) return Refusal::irregular;
    const std::array<VertexId, 3> corners = {c.tet(t).v[mesh::face_vertices[face][0]],
                                             c.tet(t).v[mesh::face_vertices[face][1]],
                                             c.tet(t).v[mesh::face_vertices[face][2]]};
    const VertexId v = bench.commit(change);
    if (bench.listener != nullptr) {
        // Its destination is interpolated between the first two corners, at the point's projection
        // on their edge.
        const Vec3 edge = c.position(corners[1]) - c.position(corners[0]);
        const double s = std::clamp(
            (point - c.position(corners[0])).dot(edge) / std::max(edge.squaredNorm(), 1e-300), 0.0,
            1.0);
        bench.listener->on_split(v, corners[0], corners[1], s);
    }
    return success;
}

}  // namespace dsc::kernel
