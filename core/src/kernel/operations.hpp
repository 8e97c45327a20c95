#pragma once
// The local operations (method.md, section 4). Each is one transaction: it finds its simplex,
// builds the edit, tests it and commits, or returns the reason for the refusal. `accept_above`: the
// result's least quality must be above min(old least, accept_above). The sections named below are
// those of method.md.

#include <optional>

#include "kernel/star_loop.hpp"
#include "kernel/workbench.hpp"

namespace dsc::kernel {

/// Interior edge (a, b) of tet t: the ring's best triangulation, rings of 3 to 7 [Freitag1997]
/// (section 4.3).
Outcome remove_edge(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above);
/// Whether remove_edge() would find a triangulation, or why not. A refusal holds as long as the
/// stars of a and b do not change. [parallel] with a bench for each thread.
Outcome may_remove(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above);
/// Interface edge (a, b): the other diagonal of its two interface faces; the tets of both labels at
/// the edge are re-triangulated (section 4.5).
Outcome flip_interface_edge(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above);
/// Face f of tet t, and further faces between the same two apices [Shewchuk2002] (section 4.4).
Outcome remove_faces(Workbench& bench, TetId t, unsigned face, float accept_above);
/// Creates a vertex at (1 - s) a + s b (section 4.6).
Outcome split_edge(Workbench& bench, TetId t, VertexId a, VertexId b, double s);
/// Creates a vertex at `point` inside face f of tet t (section 4.6).
Outcome split_face(Workbench& bench, TetId t, unsigned face, const Vec3& point);
/// Gives half of v's star, in the direction of w, a second vertex (section 4.6).
Outcome split_vertex(Workbench& bench, VertexId v, VertexId w);
/// The collapse of an edge: `removed` is removed, `kept` lies at (1 - weight) kept + weight removed
/// afterwards.
struct CollapsePlan {
    VertexId kept = mesh::none, removed = mesh::none;
    double weight = 0.0;
    float least = -1.0F;           ///< quality of the result
    std::optional<Vec3> wanted{};  ///< the place instead of the one that `weight` gives
};
/// The collapse of edge (a, b) that is best by quality, and what it depends on.
struct CollapseChoice {
    VertexId a = mesh::none, b = mesh::none;
    CollapsePlan best;
    bool interface_edge = false;
    bool a_moves = false, b_moves = false;
    float old = 1.0F, must_exceed = 0.0F;  ///< least qualities
};
/// Collapses edge (a, b) of tet t (section 4.7).
Outcome collapse_edge(Workbench& bench, TetId t, VertexId a, VertexId b, repair::CollapseMode mode,
                      float accept_above);
/// The first half of collapse_edge(): whether there is a place of sufficient quality, and which.
/// Both hold as long as the stars of a and b do not change. [parallel] with a bench for each
/// thread.
Outcome choose_collapse(Workbench& bench, TetId t, VertexId a, VertexId b,
                        repair::CollapseMode mode, float accept_above, CollapseChoice& choice);
/// The second half: tests and commits the collapse.
Outcome collapse_as_chosen(Workbench& bench, const CollapseChoice& choice);
/// Collapses the interface edge (kept, removed) of tet t into one vertex at `place`, within the
/// edit bounds and above the quality floor. A kept vertex that may not move stays at its place
/// (section 4.7).
Outcome collapse_edge_to(Workbench& bench, TetId t, VertexId kept, VertexId removed,
                         const Vec3& place);
/// Whether v may be smoothed and a gain is possible, or the reason why not (section 4.2).
/// [parallel]
Outcome may_smooth(const Workbench& bench, VertexId v, float accept_above);
/// The place that smooth_laplacian() would give v: reads scratch.star with the neighbours, writes
/// scratch.place and scratch.qualities. [parallel]
Outcome plan_laplacian(const mesh::Complex& complex, const Limits& limits, VertexId v,
                       float accept_above, StarScratch& scratch);
/// Moves an interior vertex to the mean of its neighbours (section 4.2).
Outcome smooth_laplacian(Workbench& bench, VertexId v, float accept_above);
/// Moves an interior vertex along the gradient of the least quality of its star (section 4.2).
Outcome smooth_optimise(Workbench& bench, VertexId v);
/// Gives tet t the label around it if the interface only shifts (section 4.8).
Outcome relabel_tet(Workbench& bench, TetId t);
/// Split and collapse in one edit: the repair that fits the tet's shape (two edges, an edge, a
/// face), or the repair of the named vertex or edge (section 4.9). The result's least quality must
/// be above min(gain * old least, accept_above).
Outcome compound(Workbench& bench, TetId t, const repair::Request& request);

/// What is certain of a request that names no simplex, before its turn: as long as the stars of its
/// tet do not change, execute() will refuse the first `edges` that it tries.
struct Foresight {
    std::uint8_t edges = 0;
    Refusal reason = Refusal::not_applicable;  ///< the strongest of the reasons
    /// What choose_collapse() finds for the next edge; without vertices if it was not asked.
    CollapseChoice choice{};

    bool is_empty() const { return edges == 0 && choice.a == mesh::none; }
};
/// Whether foresee() may find something: the request is an edge removal or collapse that names only
/// a tet.
bool foreseeable(const repair::Request& request);
/// Tries the edges of the tet up to the first that may succeed. [parallel] with a bench for each
/// thread.
Foresight foresee(Workbench& bench, const repair::Request& request);
/// Executes a request and chooses the simplex if the request names none (section 6.1).
Outcome execute(Workbench& bench, const repair::Request& request, const Foresight& known = {});

}  // namespace dsc::kernel
