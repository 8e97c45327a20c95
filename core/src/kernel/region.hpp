#pragma once
// Sets of tets of one label that could take another without leaving a pinched vertex: balls with a boundary of patches.

#include <vector>

#include "kernel/workbench.hpp"

namespace dsc::kernel {

/// Why a region was not taken.
enum class RegionFault : std::uint8_t { none, irregular, too_large, not_a_ball, kind, box, labels };

/// A set of tets of one label that could take another.
struct Region {
    std::vector<TetId> tets;
    mesh::Label from = 0, to = 0;
    unsigned patches_from = 0;  ///< s: edge-connected patches of the boundary that face `from`
    unsigned patches_to = 0;    ///< o: those that face `to`
    double volume = 0.0, area_from = 0.0, area_to = 0.0;
    Vec3 centroid = Vec3::Zero();
    std::vector<VertexId> patch_a, patch_b;  ///< vertices of the two patches of the side that has two
};

/// Grows the region until every vertex is regular with `to` on it, or says why not. [step]
RegionFault grow(Workbench& bench, Region& region);
/// Whether the region as it is leaves all its vertices regular. [step]
bool regular(Workbench& bench, const Region& region);
/// Patches, areas, volume, centroid; not_a_ball unless the boundary is one closed surface of Euler number 2. [step]
RegionFault measure(const Workbench& bench, Region& region);
/// Length that decides: sheet or gap thickness, or the diameter of a neck where two patches face `from`.
double thickness(const Region& region);
bool touches_box(const mesh::Complex& complex, TetId t);

}  // namespace dsc::kernel
