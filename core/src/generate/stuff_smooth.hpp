#pragma once
// Moves the vertices of a new interface without harm to the quality of tets.

#include <span>

#include <dsc/base/workers.hpp>

#include "generate/stuff_cut.hpp"

namespace dsc::generate::stuffing {

/// Moves snapped vertices to their targets. Each move is halved until no tet falls below
/// least_quality or its quality before, or it is not made. Counts clipped moves.
void move_to_targets(Stuffed& stuffed, std::span<const Snapped> snapped,
                     const StuffOptions& options, StuffReport& report);

/// The same, then smooths all interface vertices, x <- x / 2 + mean of the ring / 2, in sweeps;
/// moves are clipped as above.
void smooth_interface(Stuffed& stuffed, std::span<const Snapped> snapped,
                      const StuffOptions& options, StuffReport& report, const CancelToken* cancel);

/// Moves free vertices of bad tets towards the means of their neighbours if this raises the least
/// quality around them. Returns the least quality of all tets.
double improve_free_vertices(Stuffed& stuffed, Workers* workers);

}  // namespace dsc::generate::stuffing
