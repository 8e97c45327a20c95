#pragma once
// Rows that draw the surface to the points.

#include <span>
#include <vector>

#include <dsc/surface/face_points.hpp>

#include "rows.hpp"

namespace dsc::strategies::fit {

/// What the rows of the points are made of. Lengths in normalised units; spans per point or per vertex.
struct DataTerm {
    const surface::SurfaceView& view;
    std::span<const Vec3> points;
    std::span<const surface::FacePoint> places;   ///< per point
    std::span<const double> point_widths;         ///< per point
    std::span<const double> widths;               ///< per vertex: of the points near it
    std::span<const double> curvature;            ///< per vertex; empty: no noise to correct
    double noise = 0.0;
    double reach = 0.0;  ///< in widths; at least 6 times the noise
};

/// What became of a point.
struct PointFit {
    double weight = 0.0;  ///< area that it speaks for; 0: it lies too far off and has no row
    double distance = 0.0;
};

/// One row per point from `first` on, which exist already: the surface's nearest place, carried by the three vertices of its
/// face, shall go all the way to the point, less the part that noise adds on a curved surface. The direction is the one
/// to the point, not the face's normal: so a point beyond a crease draws the crease. `fits` gets one entry per point. [step]
void data_rows(const DataTerm& term, std::size_t first, RowSystem& system, std::vector<PointFit>& fits, Workers* workers);

}  // namespace dsc::strategies::fit
