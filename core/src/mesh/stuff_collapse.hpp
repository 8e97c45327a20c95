#pragma once
// Fewer vertices where a lattice is finer than its interface has to be.

#include "mesh/stuff_cut.hpp"

namespace dsc::mesh::stuffing {

/// Collapses interface edges, shortest first, until the interface has no more than the wanted number of vertices or no edge can
/// be collapsed, and the free vertices that would be too dense near them. Topology, regular vertices and positive tets are
/// kept. Vertices get new indices, those without tets go. Counts collapses.
void collapse_interface(Stuffed& stuffed, const StuffOptions& options, StuffReport& report, const CancelToken* cancel);

}  // namespace dsc::mesh::stuffing
