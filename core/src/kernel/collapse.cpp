// Edge collapse, with and without the interface (method.md, section 4.7).
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/star_quality.hpp>

#include "kernel/creases.hpp"
#include "kernel/operations.hpp"

namespace dsc::kernel {

struct CollapseScratch {
    // Of one end of the edge.
    struct End {
        mesh::StarWalk walk;
        std::span<const TetId> star;
        std::vector<VertexId> neighbours;  // along interface edges, by id
    };
    mesh::EdgeRing ring;
    End a, b;
    std::vector<TetId> survivors;  // the tets that the added ones come from
    mesh::TetIndex places;         // of the survivors, then of the tets that die
    std::vector<std::array<VertexId, 3>> fan, faces;
    std::vector<VertexId> concerned;  // vertices whose topology is tested

    // Few collapses need the list, so without this it could still grow in a settled step.
    CollapseScratch() { concerned.reserve(64); }
};

namespace {

using repair::CollapseMode;
using End = CollapseScratch::End;

using Plan = CollapsePlan;

class Collapse {
public:
    Collapse(Workbench& bench, VertexId a, VertexId b, bool interface_edge)
        : bench_(bench),
          own_(bench.collapse.get()),
          c_(bench.complex),
          interface_edge_(interface_edge),
          a_(a),
          b_(b) {}

    // Must come before everything that reads the stars.
    void walk() {
        own_.a.star = c_.cached_star(a_, own_.a.walk).tets;
        own_.b.star = c_.cached_star(b_, own_.b.walk).tets;
    }

    // Asks the memory for what link() and replace() will read.
    void prefetch() const {
        for (const End* end : {&own_.a, &own_.b}) {
            for (const TetId t : end->star) c_.prefetch_tet(t);
        }
    }

    float least_quality_of_stars() const {
        float least = 1.0F;
        for (const TetId t : own_.a.star) least = std::min(least, c_.quality(t));
        for (const TetId t : own_.b.star) least = std::min(least, c_.quality(t));
        return least;
    }

    // Whether v may be removed: never a vertex of the box, and an interface vertex only along the
    // interface.
    bool removable(VertexId v) const {
        if (c_.on_box(v)) return false;
        return !c_.on_interface(v) || (interface_edge_ && c_.phases(v) == 2);
    }
    // Whether v may change its position.
    bool free_to_move(VertexId v) const { return removable(v); }

    // Least quality of the remaining tets with the ends that move at `place`; -1 if it is not above
    // `bound`.
    float least(const Vec3& place, bool a_moves, bool b_moves, float bound) const {
        const auto scan = [&](const End& end, VertexId v, VertexId other) {
            return mesh::star_quality_above(bound, c_, end.star, v, place,
                                            [&](TetId t) { return remains(t, other); });
        };
        const float at_a = a_moves ? scan(own_.a, a_, b_) : 2.0F;
        if (at_a < 0.0F || !b_moves) return at_a;
        return std::min(at_a, scan(own_.b, b_, a_));
    }

    void build(const Plan& plan) {
        mesh::Edit& edit = bench_.edit;
        edit.clear();
        own_.survivors.clear();
        edit.deleted = plan.removed;
        edit.removed.assign(end(plan.removed).star.begin(), end(plan.removed).star.end());
        for (const TetId t : end(plan.removed).star) {
            if (!remains(t, plan.kept)) continue;
            mesh::NewTet tet{c_.tet(t).v, c_.label(t)};
            std::replace(tet.v.begin(), tet.v.end(), plan.removed, plan.kept);
            edit.added.push_back(tet);
            own_.survivors.push_back(t);
        }
        if (plan.weight == 0.0 && !plan.wanted) return;
        edit.moved = plan.kept;
        edit.moved_to = place(plan);
        for (const TetId t : end(plan.kept).star) {
            if (!remains(t, plan.removed)) continue;
            edit.removed.push_back(t);
            edit.added.push_back({c_.tet(t).v, c_.label(t)});
            own_.survivors.push_back(t);
        }
    }

    // Writes the neighbours of the added tets as mesh::Complex::link() would, but without a search:
    // their faces are those of the survivors. It need not test whether they fill the cavity: as all
    // of them are positive and have one common vertex, they do.
    void link(const Plan& plan) {
        mesh::Edit& edit = bench_.edit;
        for (const TetId t : edit.removed) {
            for (const VertexId v : c_.tet(t).v) c_.prefetch_star_entry(v);  // for replace()
        }
        own_.places.clear();
        for (const TetId t : own_.survivors) own_.places.insert(t);
        for (const TetId t : edit.removed) own_.places.insert(t);
        edit.neighbours.resize(edit.added.size());
        for (std::size_t i = 0; i < edit.added.size(); ++i) {
            for (unsigned f = 0; f < 4; ++f)
                edit.neighbours[i][f] = beyond(c_.across(own_.survivors[i], f), plan);
        }
    }

    Vec3 place(const Plan& plan) const {
        if (plan.wanted) return *plan.wanted;
        if (plan.weight == 1.0) return c_.position(plan.removed);
        return (1.0 - plan.weight) * c_.position(plan.kept) +
               plan.weight * c_.position(plan.removed);
    }

    // Largest distance that the interface moves: from each old vertex to the new faces, and from
    // the new place to the old faces.
    double interface_distance(const Plan& plan) {
        auto& old = own_.faces;
        auto& fan = own_.fan;
        bench_.interface_fan(plan.removed, end(plan.removed).star, old);
        bench_.interface_fan(plan.kept, end(plan.kept).star, fan);
        old.insert(old.end(), fan.begin(), fan.end());
        const Vec3 target = place(plan);
        const auto near = [](const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
            return (p - geometry::closest_point_on_triangle(p, a, b, c)).norm();
        };
        double kept = INFINITY, removed = INFINITY, back = INFINITY;
        for (const auto& face : old) {
            back = std::min(back, near(target, c_.position(face[0]), c_.position(face[1]),
                                       c_.position(face[2])));
            const bool dies = (face[1] == plan.kept || face[2] == plan.kept ||
                               face[1] == plan.removed || face[2] == plan.removed);
            if (dies) continue;
            kept = std::min(kept, near(c_.position(plan.kept), target, c_.position(face[1]),
                                       c_.position(face[2])));
            removed = std::min(removed, near(c_.position(plan.removed), target,
                                             c_.position(face[1]), c_.position(face[2])));
        }
        return std::max({kept, removed, back});
    }

    // The link condition of a surface [Dey1999]. If it holds, the interface keeps its topology and
    // every vertex stays regular: a and b have exactly the two vertices opposite their edge as
    // common neighbours. If it does not hold, nothing is known.
    bool link_condition() {
        const auto simple = [this](VertexId v) { return c_.phases(v) == 2 && !c_.on_box(v); };
        if (!simple(a_) || !simple(b_)) return false;
        find_neighbours(own_.a, a_);
        find_neighbours(own_.b, b_);
        const std::vector<VertexId>&near_a = own_.a.neighbours, &near_b = own_.b.neighbours;
        std::size_t common = 0;
        auto y = near_b.begin();
        for (const VertexId x : near_a) {
            while (y != near_b.end() && *y < x) ++y;
            if (y == near_b.end() || *y != x) continue;
            if (!simple(x)) return false;
            ++common;
        }
        // The kept vertex gets the other neighbours of both; there must be at least three.
        return common == 2 && near_a.size() + near_b.size() >= 7;
    }

    // Tests the topology at the interface vertices that both stars contain. At any other vertex no
    // tet is removed and none is joined: only a corner of its tets changes its name.
    Outcome check_topology() {
        if (link_condition()) return success;
        bench_.shared_interface_vertices(own_.a.star, own_.b.star, own_.concerned);
        return bench_.check_topology(own_.concerned);
    }

private:
    End& end(VertexId v) const { return v == a_ ? own_.a : own_.b; }

    // What lies across a face of a survivor after the collapse; `code` is what lies there now. A
    // tet outside the cavity is not read, because it is rarely in the caches.
    std::uint32_t beyond(std::uint32_t code, const Plan& plan) const {
        const std::uint32_t place = place_of(code);
        if (place == mesh::TetIndex::absent) return code;
        if (place < own_.survivors.size()) return added(place, code);
        // The two faces of a dying tet that contain one end each become one face.
        const TetId dying = mesh::neighbour_tet(code);
        const mesh::Tet& tet = c_.tet(dying);
        const bool at_removed = tet.v[mesh::neighbour_face(code)] == plan.kept;
        const std::uint32_t next =
            c_.across(dying, mesh::index_of(tet, at_removed ? plan.removed : plan.kept));
        const std::uint32_t next_place = place_of(next);
        return next_place < own_.survivors.size() ? added(next_place, next) : next;
    }
    std::uint32_t place_of(std::uint32_t code) const {
        return code == mesh::none ? mesh::TetIndex::absent
                                  : own_.places.find(mesh::neighbour_tet(code));
    }
    // The code of the added tet that comes from a survivor.
    static std::uint32_t added(std::uint32_t place, std::uint32_t code) {
        return mesh::Edit::virtual_code | (4 * place + mesh::neighbour_face(code));
    }

    // Whether a tet of one end's star does not contain the other end.
    bool remains(TetId t, VertexId other) const { return !mesh::has_vertex(c_.tet(t), other); }

    void find_neighbours(End& end, VertexId v) const {
        bench_.interface_fan(v, end.star, own_.fan);
        std::vector<VertexId>& out = end.neighbours;
        out.clear();
        for (const auto& face : own_.fan) out.insert(out.end(), {face[1], face[2]});
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
    }

    Workbench& bench_;
    CollapseScratch& own_;
    mesh::Complex& c_;
    bool interface_edge_;
    VertexId a_ = mesh::none, b_ = mesh::none;
};

bool is_interface_edge(const mesh::Complex& c, const mesh::EdgeRing& ring) {
    const mesh::Label first = c.label(ring.tets.front());
    return std::any_of(ring.tets.begin(), ring.tets.end(),
                       [&](TetId t) { return c.label(t) != first; });
}

// Tests and commits the collapse.
Outcome finish(Workbench& bench, Collapse& collapse, const Plan& plan, bool interface_edge,
               float must_exceed, float old) {
    InterfaceChange change;
    collapse.build(plan);
    if (interface_edge) {
        change = {collapse.interface_distance(plan), bench.phase_change()};
        if (change.exceeds(bench.bounds_at(plan.kept, plan.removed))) return Refusal::bound;
    }
    if (const Outcome o = bench.check_shape(must_exceed, old); o.refused()) return o;
    collapse.link(plan);
    if (interface_edge) {
        if (const Outcome o = collapse.check_topology(); o.refused()) return o;
        if (const Outcome o = check_creases(bench, plan.kept, plan.removed); o.refused()) return o;
    }
    bench.commit(change);
    if (bench.listener != nullptr) {
        bench.listener->on_collapse(plan.kept, plan.removed, plan.weight);
        if (interface_edge) bench.listener->on_interface_collapse(plan.kept);
    }
    return success;
}

}  // namespace

// Reads the stars of a and b only.
Outcome choose_collapse(Workbench& bench, TetId t, VertexId a, VertexId b, CollapseMode mode,
                        float accept_above, CollapseChoice& choice) {
    choice = {a, b, {}};
    const mesh::Complex& c = bench.complex;
    // Only an edge with both ends on the box or on the interface can lie there.
    bool& interface_edge = choice.interface_edge;
    if ((c.on_box(a) && c.on_box(b)) || (c.on_interface(a) && c.on_interface(b))) {
        mesh::EdgeRing& ring = bench.collapse.get().ring;
        c.ring(t, a, b, ring);
        if (!ring.closed) return Refusal::box;
        interface_edge = is_interface_edge(c, ring);
    }
    if (interface_edge && (c.on_box(a) || c.on_box(b))) return Refusal::box;
    Collapse collapse(bench, a, b, interface_edge);
    const bool a_goes = collapse.removable(a), b_goes = collapse.removable(b);
    if (!a_goes && !b_goes)
        return c.on_box(a) || c.on_box(b) ? Refusal::box : Refusal::not_applicable;
    // In safe mode the interface may be edited only if it is flat round the vertex that leaves its
    // place.
    const bool shape_matters = interface_edge && mode == CollapseMode::safe;
    const bool a_moves = choice.a_moves = a_goes && (!shape_matters || bench.flat(a));
    const bool b_moves = choice.b_moves = b_goes && (!shape_matters || bench.flat(b));
    if (!a_moves && !b_moves) return Refusal::bound;
    collapse.walk();

    choice.old = collapse.least_quality_of_stars();
    choice.must_exceed = std::min(choice.old, accept_above);
    Plan& best = choice.best;
    const auto offer = [&](VertexId kept, VertexId removed, double weight, const Vec3& place,
                           bool moves_a, bool moves_b) {
        const float least =
            collapse.least(place, moves_a, moves_b, std::max(choice.must_exceed, best.least));
        if (least > best.least) best = {kept, removed, weight, least};
    };
    if (a_moves) offer(b, a, 0.0, c.position(b), true, false);
    if (b_moves) offer(a, b, 0.0, c.position(a), false, true);
    const bool interior_pair = !c.on_interface(a) && !c.on_interface(b);
    if (a_moves && b_moves && (interface_edge || interior_pair)) {
        offer(a, b, 0.5, 0.5 * (c.position(a) + c.position(b)), true, true);
    }
    return best.kept == mesh::none ? Outcome(Refusal::quality) : success;
}

Outcome collapse_edge(Workbench& bench, TetId t, VertexId a, VertexId b, CollapseMode mode,
                      float accept_above) {
    CollapseChoice choice;
    const Outcome o = choose_collapse(bench, t, a, b, mode, accept_above, choice);
    return o.refused() ? o : collapse_as_chosen(bench, choice);
}

Outcome collapse_as_chosen(Workbench& bench, const CollapseChoice& choice) {
    const auto& [a, b, best, interface_edge, a_moves, b_moves, old, must_exceed] = choice;
    const mesh::Complex& c = bench.complex;
    Collapse collapse(bench, a, b, interface_edge);
    collapse.walk();  // also if another bench has chosen
    collapse.prefetch();
    const Outcome result = finish(bench, collapse, best, interface_edge, must_exceed, old);
    if (result != Refusal::bound || !interface_edge || !bench.limits.keeps_creases()) return result;
    // Also with exchanged ends, or into the end that lies on a crease.
    for (const auto& [kept, removed] : {std::array{a, b}, std::array{b, a}}) {
        const bool to_a = kept == a;
        if (!(to_a ? b_moves : a_moves) || (best.kept == kept && best.weight == 0.0)) continue;
        const float least = collapse.least(c.position(kept), !to_a, to_a, must_exceed);
        if (!(least > must_exceed)) continue;
        if (!finish(bench, collapse, {kept, removed, 0.0, least}, true, must_exceed, old).refused())
            return success;
    }
    return result;
}

Outcome collapse_edge_to(Workbench& bench, TetId t, VertexId kept, VertexId removed,
                         const Vec3& place) {
    mesh::Complex& c = bench.complex;
    mesh::EdgeRing& ring = bench.collapse.get().ring;
    c.ring(t, kept, removed, ring);
    if (!ring.closed) return Refusal::box;
    if (!is_interface_edge(c, ring)) return Refusal::not_applicable;
    if (c.on_box(kept) || c.on_box(removed)) return Refusal::box;
    Collapse collapse(bench, kept, removed, true);
    if (!collapse.removable(removed)) return Refusal::not_applicable;
    collapse.walk();
    Plan plan{kept, removed};
    if (collapse.free_to_move(kept)) plan.wanted = place;
    return finish(bench, collapse, plan, true, 0.0F, collapse.least_quality_of_stars());
}

}  // namespace dsc::kernel
