#pragma once
// The local operations. Each is one transaction: it looks for its simplex, builds the edit, judges it and commits, or
// says why not. `accept_above`: the result's least quality must be above min(old least, accept_above).

#include "kernel/workbench.hpp"

namespace dsc::kernel {

/// Interior edge (a, b) of tet t: the ring's best triangulation, rings of 3 to 7 [Freitag1997].
Refusal remove_edge(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above);
/// Interface edge (a, b): the other diagonal of its two interface faces; both labels' fans are re-triangulated.
Refusal flip_interface_edge(Workbench& bench, TetId t, VertexId a, VertexId b, float accept_above);
/// Face f of tet t and its sandwiched neighbours between the two apices [Shewchuk2002].
Refusal remove_faces(Workbench& bench, TetId t, unsigned face, float accept_above);
/// A vertex at (1 - s) a + s b.
Refusal split_edge(Workbench& bench, TetId t, VertexId a, VertexId b, double s);
/// A vertex at `point` inside face f of tet t.
Refusal split_face(Workbench& bench, TetId t, unsigned face, const Vec3& point);
/// A second vertex for half of v's star, in the direction of w.
Refusal split_vertex(Workbench& bench, VertexId v, VertexId w);
/// Edge (a, b) of tet t.
Refusal collapse_edge(Workbench& bench, TetId t, VertexId a, VertexId b, mesh::CollapseMode mode, float accept_above);
/// Interface edge (kept, removed) of tet t becomes one vertex at `place`, within the edit bounds and above the quality floor.
/// A kept vertex that may not move stays where it is.
Refusal collapse_edge_to(Workbench& bench, TetId t, VertexId kept, VertexId removed, const Vec3& place);
/// Whether v may be smoothed and is not known to gain nothing by it: `committed`, or why not. [parallel]
Refusal may_smooth(const Workbench& bench, VertexId v, float accept_above);
/// Where smooth_laplacian() would put v: from scratch.star to scratch.place and scratch.qualities. [parallel]
Refusal plan_laplacian(const mesh::Complex& complex, const Limits& limits, VertexId v, float accept_above, StarScratch& scratch);
/// Interior vertex to the mean of its neighbours.
Refusal smooth_laplacian(Workbench& bench, VertexId v, float accept_above);
/// Interior vertex uphill on the least quality of its star.
Refusal smooth_optimise(Workbench& bench, VertexId v);
/// Tet t takes the label around it if the interface only shifts.
Refusal relabel_tet(Workbench& bench, TetId t);
/// Split and collapse as one: the repair that fits the tet's shape (two edges, an edge, a face), or that of the named vertex or
/// edge. The result's least quality must be above min(gain * old least, accept_above).
Refusal compound(Workbench& bench, TetId t, const mesh::Request& request);

/// Carries out a request, choosing the simplex where it names none.
Refusal execute(Workbench& bench, const mesh::Request& request);

}  // namespace dsc::kernel
