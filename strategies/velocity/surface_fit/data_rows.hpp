#pragma once
// Rows that pull the surface to the points.

#include <span>
#include <vector>

#include <dsc/surface/face_points.hpp>

#include "rows.hpp"

namespace dsc::strategies::fit {

/// The data for the rows of the points. Lengths are in normalised units; spans are per point or per
/// vertex.
struct DataTerm {
    const surface::SurfaceView& view;
    std::span<const Vec3> points;
    std::span<const surface::FacePoint> places;  ///< per point
    std::span<const double> point_widths;        ///< per point
    std::span<const double> widths;              ///< per vertex: of the points near it
    std::span<const double> curvature;           ///< per vertex; empty: no correction for noise
    double noise = 0.0;
    double reach = 0.0;  ///< in widths; at least 6 times the noise
};

/// The result for a point.
struct PointFit {
    double weight = 0.0;  ///< area that it represents; 0: it is too far away and has no row
    double distance = 0.0;
};

/// Writes one row per point from `first` on, which already exist: the surface's nearest place, a
/// combination of the three vertices of its face, is to move all the way to the point, minus the
/// part that noise adds on a curved surface. The direction is that to the point, not the face's
/// normal, so that a point beyond a crease pulls the crease. `fits` gets one entry per point.
/// [step]
void data_rows(const DataTerm& term, std::size_t first, RowSystem& system,
               std::vector<PointFit>& fits, Workers* workers);

}  // namespace dsc::strategies::fit
