#pragma once
// A smooth surface over holes in the data.

#include <cstdint>
#include <span>
#include <vector>

#include "surface_links.hpp"

namespace dsc::strategies::fit {

/// Moves the vertices of holes to the places where the sum of their squared uniform Laplacians, and
/// those of the vertices next to them, is smallest: this continues the surface around a hole over
/// it. Vertices of holes are movable, have a gap above 1 and at least two such neighbours. Pieces
/// of the surface that consist only of such vertices stay as they are, and so do holes with more
/// than a quarter of the vertices, which are probably a side that was not scanned. `positions` is
/// input and output. Returns the number of vertices that it moved. [step]
std::size_t fill_holes(const SurfaceLinks& links, std::span<const double> gaps,
                       std::span<const std::uint8_t> movable, std::vector<Vec3>& positions);

}  // namespace dsc::strategies::fit
