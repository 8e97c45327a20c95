#pragma once
// Mean curvature at the vertices, from the angles of the edges.

#include <vector>

#include <dsc/base/workers.hpp>

#include "surface_links.hpp"

namespace dsc::strategies::fit {

/// (k1 + k2) / 2 at each vertex, above 0 where the solid is convex: the sum of length times angle
/// over the edges of a few rings, divided by their area, limited to [-largest, largest]. Angles
/// above half a radian count as half a radian. [step]
void measure_curvature(const surface::SurfaceView& view, const SurfaceLinks& links, double largest,
                       Workers* workers, std::vector<double>& curvature);

}  // namespace dsc::strategies::fit
