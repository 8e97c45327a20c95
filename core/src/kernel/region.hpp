#pragma once
// Sets of tets of one label that can take another label without leaving a pinched vertex
// (method.md, section 8.2).

#include <vector>

#include "kernel/workbench.hpp"

namespace dsc::kernel {

/// Why a region was refused.
enum class RegionFault : std::uint8_t { none, irregular, too_large, not_a_ball, kind, box, labels };

/// A set of tets of one label that could take another label.
struct Region {
    std::vector<TetId> tets;
    mesh::Label from = 0, to = 0;
    unsigned patches_from = 0;  ///< s: edge-connected patches of the boundary that face `from`
    unsigned patches_to = 0;    ///< o: those that face `to`
    double volume = 0.0, area_from = 0.0, area_to = 0.0;
    Vec3 centroid = Vec3::Zero();
    std::vector<VertexId> patch_a, patch_b;  ///< vertices of the two patches, on the side that has
                                             ///< two
};

/// Grows the region until every vertex is regular with label `to` on the region, or returns the
/// fault. [step]
RegionFault grow(Workbench& bench, Region& region);
/// Whether all vertices of the region are regular with label `to` on it, without growth. [step]
bool regular(Workbench& bench, const Region& region);
/// Computes patches, areas, volume and centroid; not_a_ball unless the boundary is one closed
/// surface of Euler number 2. [step]
RegionFault measure(Workbench& bench, Region& region);
/// The length that the limit applies to: thickness of a sheet or gap, or diameter of a neck if two
/// patches face `from`.
double thickness(const Region& region);
/// The relabelling of the region; valid as long as the region.
inline Relabelling relabelling(const Region& region) {
    return {region.tets, region.to, region.volume};
}
bool touches_box(const mesh::Complex& complex, TetId t);

}  // namespace dsc::kernel
