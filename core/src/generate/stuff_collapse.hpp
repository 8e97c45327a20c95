#pragma once
// Reduces the number of vertices where a lattice is finer than its interface requires.

#include "generate/stuff_cut.hpp"

namespace dsc::generate::stuffing {

/// Collapses interface edges, shortest first, until the interface has no more than the wanted
/// number of vertices or no edge can be collapsed; also collapses free vertices that would be too
/// dense near the interface. Topology, regular vertices and positive tets are kept. Vertices get
/// new indices; vertices without tets are removed. Counts the collapses.
void collapse_interface(Stuffed& stuffed, const StuffOptions& options, StuffReport& report,
                        const CancelToken* cancel);

}  // namespace dsc::generate::stuffing
