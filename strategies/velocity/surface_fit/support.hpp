#pragma once
// What the points say about each vertex, for files and reports.

#include <span>
#include <vector>

#include <dsc/surface/face_points.hpp>

#include "data_rows.hpp"

namespace dsc::strategies::fit {

/// One value per vertex.
struct Support {
    std::vector<double> share;     ///< of the area of the vertex that points speak for; at most 1
    std::vector<double> residual;  ///< root mean square distance of these points from the surface; 0 without one
};

/// Over the points whose nearest place lies in a face of the vertex, each by the vertex's part in that place: so it does not
/// matter to which face the host gives a point that lies nearest to an edge. [step]
void measure_support(const surface::SurfaceView& view, std::span<const surface::FacePoint> places, std::span<const PointFit> fits,
                     Support& support);

}  // namespace dsc::strategies::fit
