#pragma once
// From the octree's cells to tets [LabelleShewchuk2007].

#include <dsc/base/progress.hpp>
#include <dsc/mesh/tet_mesh.hpp>

#include "octree.hpp"

namespace dsc::strategies::lattice {

/// Tets of the finest cells: five of each cell by itself, or those of all larger cells.
enum class Pattern { parity, bcc };

/// Fills the box with positive tets, cells in Morton order, vertices in the order of their first use.
///
/// A tet of a larger cell joins its centre, an edge of one of its faces and, across that face, the centre of the
/// neighbour of equal size or else the centre of the face. Where a smaller cell halves the edge, the tet is
/// halved. A face that is a quarter of a larger cell's is joined to the centre as two triangles. Throws
/// CancelledError.
mesh::TetMesh tile(const Octree& octree, const Frame& frame, std::span<const mesh::Shape> shapes,
                   Pattern finest, const CancelToken* cancel);

}  // namespace dsc::strategies::lattice
