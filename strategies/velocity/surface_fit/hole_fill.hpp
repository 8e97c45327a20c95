#pragma once
// A smooth surface over holes in the data.

#include <cstdint>
#include <span>
#include <vector>

#include "surface_links.hpp"

namespace dsc::strategies::fit {

/// Moves the vertices of holes to where the sum of their squared uniform Laplacians, and those of the vertices next to
/// them, is least: the surface round a hole is continued over it. Vertices of holes are movable, have a gap above 1 and at
/// least two neighbours that have one. Pieces of the surface of which nothing else is left stay
/// as they are, and so do holes with more than a quarter of the vertices, which are rather a side that nobody has seen. `positions` in
/// and out. Returns how many vertices it moved. [step]
std::size_t fill_holes(const SurfaceLinks& links, std::span<const double> gaps, std::span<const std::uint8_t> movable,
                       std::vector<Vec3>& positions);

}  // namespace dsc::strategies::fit
