// Edge collapse, with and without the interface (method.md, section 4.7).
#include <cmath>
#include <optional>

#include <dsc/geometry/quality.hpp>

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"

namespace dsc::kernel {
namespace {

using repair::CollapseMode;

// The edge to collapse: `removed` is removed, `kept` lies at (1 - weight) kept + weight removed afterwards.
struct Plan {
    VertexId kept = mesh::none, removed = mesh::none;
    double weight = 0.0;
    float least = -1.0F;
    std::optional<Vec3> wanted{};  // the place instead of the one that `weight` gives
};

class Collapse {
public:
    Collapse(Workbench& bench, VertexId a, VertexId b, bool interface_edge)
        : bench_(bench), c_(bench.complex), interface_edge_(interface_edge) {
        c_.star(a, bench.star_a);
        c_.star(b, bench.star_b);
        a_ = a;
        b_ = b;
    }

    // Whether v may be removed: never a vertex of the box, and an interface vertex only along the interface.
    bool removable(VertexId v) const {
        if (c_.on_box(v)) return false;
        return !c_.on_interface(v) || (interface_edge_ && c_.phases(v) == 2);
    }
    // Whether v may change its position.
    bool free_to_move(VertexId v) const { return removable(v); }

    // Least quality of the remaining tets with both ends at `place`; ends early at `bound`.
    float least(const Vec3& place, bool a_moves, bool b_moves, float bound) const {
        float least = 2.0F;
        const auto scan = [&](const std::vector<TetId>& star, VertexId own, VertexId other) {
            for (const TetId t : star) {
                const auto& v = c_.tet(t).v;
                if (mesh::has_vertex(c_.tet(t), other)) continue;
                std::array<const Vec3*, 4> p{};
                for (unsigned i = 0; i < 4; ++i) p[i] = v[i] == own ? &place : &c_.position(v[i]);
                least = std::min(least, static_cast<float>(geometry::tet_quality(*p[0], *p[1], *p[2], *p[3])));
                if (!(least > bound)) return false;
            }
            return true;
        };
        if (a_moves && !scan(bench_.star_a, a_, b_)) return -1.0F;
        if (b_moves && !scan(bench_.star_b, b_, a_)) return -1.0F;
        return least;
    }

    void build(const Plan& plan) {
        mesh::Edit& edit = bench_.edit;
        edit.clear();
        edit.deleted = plan.removed;
        const auto& star_removed = plan.removed == a_ ? bench_.star_a : bench_.star_b;
        const auto& star_kept = plan.removed == a_ ? bench_.star_b : bench_.star_a;
        edit.removed = star_removed;
        for (const TetId t : star_removed) {
            if (mesh::has_vertex(c_.tet(t), plan.kept)) continue;
            mesh::NewTet tet{c_.tet(t).v, c_.label(t)};
            std::replace(tet.v.begin(), tet.v.end(), plan.removed, plan.kept);
            edit.added.push_back(tet);
        }
        if (plan.weight == 0.0 && !plan.wanted) return;
        edit.moved = plan.kept;
        edit.moved_to = place(plan);
        for (const TetId t : star_kept) {
            if (mesh::has_vertex(c_.tet(t), plan.removed)) continue;
            edit.removed.push_back(t);
            edit.added.push_back({c_.tet(t).v, c_.label(t)});
        }
    }

    Vec3 place(const Plan& plan) const {
        if (plan.wanted) return *plan.wanted;
        if (plan.weight == 1.0) return c_.position(plan.removed);
        return (1.0 - plan.weight) * c_.position(plan.kept) + plan.weight * c_.position(plan.removed);
    }

    // Largest distance that the interface moves: from each old vertex to the new faces, and from the new place to the old
    // faces.
    double interface_distance(const Plan& plan) {
        auto& old = bench_.faces;
        auto& fan = bench_.fan;
        bench_.interface_fan(plan.removed, plan.removed == a_ ? bench_.star_a : bench_.star_b, fan);
        old = fan;
        bench_.interface_fan(plan.kept, plan.removed == a_ ? bench_.star_b : bench_.star_a, fan);
        old.insert(old.end(), fan.begin(), fan.end());
        const Vec3 target = place(plan);
        const auto near = [](const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
            return (p - geometry::closest_point_on_triangle(p, a, b, c)).norm();
        };
        double kept = INFINITY, removed = INFINITY, back = INFINITY;
        for (const auto& face : old) {
            back = std::min(back, near(target, c_.position(face[0]), c_.position(face[1]), c_.position(face[2])));
            const bool dies = (face[1] == plan.kept || face[2] == plan.kept || face[1] == plan.removed || face[2] == plan.removed);
            if (dies) continue;
            kept = std::min(kept, near(c_.position(plan.kept), target, c_.position(face[1]), c_.position(face[2])));
            removed = std::min(removed, near(c_.position(plan.removed), target, c_.position(face[1]), c_.position(face[2])));
        }
        return std::max({kept, removed, back});
    }

    // The link condition of a surface [Dey1999]. If it holds, the interface keeps its topology and every vertex stays regular:
    // a and b have exactly the two vertices opposite their edge as common neighbours. If it does not hold, nothing is known.
    bool link_condition() {
        const auto simple = [this](VertexId v) { return c_.phases(v) == 2 && !c_.on_box(v); };
        if (!simple(a_) || !simple(b_)) return false;
        interface_neighbours(a_, bench_.star_a, bench_.near_a);
        interface_neighbours(b_, bench_.star_b, bench_.near_b);
        std::size_t common = 0;
        auto y = bench_.near_b.begin();
        for (const VertexId x : bench_.near_a) {
            while (y != bench_.near_b.end() && *y < x) ++y;
            if (y == bench_.near_b.end() || *y != x) continue;
            if (!simple(x)) return false;
            ++common;
        }
        // The kept vertex gets the other neighbours of both; there must be at least three.
        return common == 2 && bench_.near_a.size() + bench_.near_b.size() >= 7;
    }

private:
    // The other ends of v's interface edges, by id.
    void interface_neighbours(VertexId v, std::span<const TetId> star, std::vector<VertexId>& out) const {
        bench_.interface_fan(v, star, bench_.fan);
        out.clear();
        for (const auto& face : bench_.fan) out.insert(out.end(), {face[1], face[2]});
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
    }

    Workbench& bench_;
    mesh::Complex& c_;
    bool interface_edge_;
    VertexId a_ = mesh::none, b_ = mesh::none;
};

bool is_interface_edge(const Workbench& bench) {
    const auto& tets = bench.ring.tets;
    const mesh::Label first = bench.complex.label(tets.front());
    return std::any_of(tets.begin(), tets.end(), [&](TetId t) { return bench.complex.label(t) != first; });
}

// Tests and commits the collapse in the bench.
Refusal finish(Workbench& bench, Collapse& collapse, const Plan& plan, bool interface_edge, float must_exceed, float old) {
    mesh::Complex& c = bench.complex;
    double distance = 0.0, volume = 0.0;
    collapse.build(plan);
    if (interface_edge) {
        distance = collapse.interface_distance(plan);
        volume = bench.phase_change();
        const EditBounds bounds = bench.bounds_at(plan.kept, plan.removed);
        if (distance > bounds.distance || volume > bounds.volume) return Refusal::bound;
    }
    if (const Refusal r = bench.check_shape(must_exceed, old); r != Refusal::committed) return r;
    if (!c.link(bench.edit)) return Refusal::irregular;
    if (interface_edge && !collapse.link_condition()) {
        // At any other vertex no tet is removed and none is joined: only a corner of its tets changes its name.
        bench.shared_interface_vertices(bench.vertices);
        if (const Refusal r = bench.check_topology(bench.vertices); r != Refusal::committed) return r;
    }
    if (interface_edge) {
        if (const Refusal r = check_creases(bench, plan.kept, plan.removed); r != Refusal::committed) return r;
    }
    bench.commit(distance, volume);
    if (bench.listener != nullptr) {
        bench.listener->on_collapse(plan.kept, plan.removed, plan.weight);
        if (interface_edge) bench.listener->on_interface_collapse(plan.kept);
    }
    return Refusal::committed;
}

float least_quality_of_stars(const Workbench& bench) {
    float least = 1.0F;
    for (const TetId s : bench.star_a) least = std::min(least, bench.complex.quality(s));
    for (const TetId s : bench.star_b) least = std::min(least, bench.complex.quality(s));
    return least;
}

}  // namespace

Refusal collapse_edge(Workbench& bench, TetId t, VertexId a, VertexId b, CollapseMode mode, float accept_above) {
    mesh::Complex& c = bench.complex;
    c.ring(t, a, b, bench.ring);
    if (!bench.ring.closed) return Refusal::box;
    const bool interface_edge = is_interface_edge(bench);
    if (interface_edge && (c.on_box(a) || c.on_box(b))) return Refusal::box;
    Collapse collapse(bench, a, b, interface_edge);
    const bool a_goes = collapse.removable(a), b_goes = collapse.removable(b);
    if (!a_goes && !b_goes) return c.on_box(a) || c.on_box(b) ? Refusal::box : Refusal::not_applicable;
    // In safe mode the interface may be edited only if it is flat round the vertex that leaves its place.
    const bool shape_matters = interface_edge && mode == CollapseMode::safe;
    const bool a_moves = a_goes && (!shape_matters || bench.flat(a, bench.star_a));
    const bool b_moves = b_goes && (!shape_matters || bench.flat(b, bench.star_b));
    if (!a_moves && !b_moves) return Refusal::bound;

    const float old = least_quality_of_stars(bench);
    const float must_exceed = std::min(old, accept_above);
    Plan best;
    const auto offer = [&](VertexId kept, VertexId removed, double weight, const Vec3& place, bool moves_a, bool moves_b) {
        const float least = collapse.least(place, moves_a, moves_b, std::max(must_exceed, best.least));
        if (least > best.least) best = {kept, removed, weight, least};
    };
    if (a_moves) offer(b, a, 0.0, c.position(b), true, false);
    if (b_moves) offer(a, b, 0.0, c.position(a), false, true);
    const bool interior_pair = !c.on_interface(a) && !c.on_interface(b);
    if (a_moves && b_moves && (interface_edge || interior_pair)) {
        offer(a, b, 0.5, 0.5 * (c.position(a) + c.position(b)), true, true);
    }
    if (best.kept == mesh::none) return Refusal::quality;

    const Refusal result = finish(bench, collapse, best, interface_edge, must_exceed, old);
    if (result != Refusal::bound || !interface_edge || !bench.limits.keeps_creases()) return result;
    // Also with exchanged ends, or into the end that lies on a crease.
    for (const auto& [kept, removed] : {std::array{a, b}, std::array{b, a}}) {
        const bool to_a = kept == a;
        if (!(to_a ? b_moves : a_moves) || (best.kept == kept && best.weight == 0.0)) continue;
        const float least = collapse.least(c.position(kept), !to_a, to_a, must_exceed);
        if (!(least > must_exceed)) continue;
        if (finish(bench, collapse, {kept, removed, 0.0, least}, true, must_exceed, old) == Refusal::committed) return Refusal::committed;
    }
    return result;
}

Refusal collapse_edge_to(Workbench& bench, TetId t, VertexId kept, VertexId removed, const Vec3& place) {
    mesh::Complex& c = bench.complex;
    c.ring(t, kept, removed, bench.ring);
    if (!bench.ring.closed) return Refusal::box;
    if (!is_interface_edge(bench)) return Refusal::not_applicable;
    if (c.on_box(kept) || c.on_box(removed)) return Refusal::box;
    Collapse collapse(bench, kept, removed, true);
    if (!collapse.removable(removed)) return Refusal::not_applicable;
    Plan plan{kept, removed};
    if (collapse.free_to_move(kept)) plan.wanted = place;
    return finish(bench, collapse, plan, true, 0.0F, least_quality_of_stars(bench));
}

}  // namespace dsc::kernel
