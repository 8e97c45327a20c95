#pragma once
// Moves of the vertices of a new interface that no tet suffers from.

#include <span>

#include "mesh/stuff_cut.hpp"

namespace dsc::mesh::stuffing {

/// First moves the snapped vertices to their targets, then smooths all interface vertices, x <- x / 2 + mean of the ring / 2,
/// in sweeps. Each move is halved until no tet falls below least_quality or what it had before, or given up. Counts clipped
/// moves.
void smooth_interface(Stuffed& stuffed, std::span<const Snapped> snapped, const StuffOptions& options, StuffReport& report,
                      const CancelToken* cancel);

}  // namespace dsc::mesh::stuffing
