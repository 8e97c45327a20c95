#pragma once
// Support and residual of each vertex, for files and reports.

#include <span>
#include <vector>

#include <dsc/surface/face_points.hpp>

#include "data_rows.hpp"

namespace dsc::strategies::fit {

/// One value per vertex.
struct Support {
    std::vector<double> share;     ///< fraction of the vertex' area for which there are points; at
                                   ///< most 1
    std::vector<double> residual;  ///< root mean square distance of these points from the surface;
                                   ///< 0 without points
};

/// Sums over the points whose nearest place lies in a face of the vertex, weighted by the vertex'
/// part in that place, so that it does not matter to which face the host assigns a point that is
/// nearest to an edge. [step]
void measure_support(const surface::SurfaceView& view, std::span<const surface::FacePoint> places,
                     std::span<const PointFit> fits, Support& support);

}  // namespace dsc::strategies::fit
