#pragma once
// Cuts tets with corners on both sides of the interface along it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "generate/stuff_snap.hpp"

namespace dsc::generate::stuffing {

/// A triangle of the interface.
using Face = std::array<std::uint32_t, 3>;

/// A labelled mesh with the faces between its labels.
struct Stuffed {
    mesh::TetMesh mesh;
    std::vector<Face> faces;
};

/// Cuts the mixed edges at their cut points and splits the mixed tets so that they fit together.
/// Quads on faces of the lattice get the diagonal from the end of lower index; quads in the
/// interface get the shorter one. Edges with a snapped end are not cut. No tet has four snapped
/// vertices.
Stuffed cut_tets(const LatticeView& lattice, std::span<const MixedEdge> edges,
                 const EdgeTable& table, const Signs& signs);

}  // namespace dsc::generate::stuffing
