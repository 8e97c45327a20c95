#pragma once
// Makes tets from the octree's cells [LabelleShewchuk2007].

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/mesh/tet_mesh.hpp>

#include "generate/lattice_octree.hpp"
#include "generate/vertex_table.hpp"

namespace dsc::generate::lattice {

/// Fills the box with positive tets, cells in Morton order, vertices in the order of their first
/// use.
///
/// A tet of a larger cell joins its centre, an edge of one of its faces and, across that face, the
/// centre of the neighbour of equal size or else the centre of the face. Where a smaller cell
/// halves the edge, the tet is halved. A face that is a quarter of a larger cell's is joined to the
/// centre as two triangles. All labels are 0. Throws CancelledError.
mesh::TetMesh tile(const Octree& octree, const Frame& frame, LatticePattern finest,
                   const CancelToken* cancel);

/// Vertices of a tet.
using Corners = std::array<std::uint32_t, 4>;

/// The same tets with the vertex numbers of the table, which must contain all of them. `workers`,
/// null for one thread, share the work.
std::vector<Corners> tile(const Octree& octree, LatticePattern finest, const VertexTable& table,
                          Workers* workers, const CancelToken* cancel);

}  // namespace dsc::generate::lattice
