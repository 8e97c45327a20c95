#pragma once
// Normals of faces, smoothed within smooth parts but not across creases.

#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::strategies::fit {

/// Unit normals of the faces after `rounds` of bilateral averages over all faces that share a
/// vertex. The weights are their area, a Gaussian of the distance of their centroids, as wide as
/// the mean of the face's `lengths` (per vertex), and a Gaussian of width `range` of the distance
/// of the unit normals. Normals that vary linearly, as on a surface of constant curvature, do not
/// change. The result is in `filtered`. [step]
void filter_normals(const surface::SurfaceView& view, unsigned rounds, double range,
                    std::span<const double> lengths, Workers* workers, std::vector<Vec3>& filtered);

}  // namespace dsc::strategies::fit
