#pragma once
// The support that StepContext::support contains.

#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/surface/face_points.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::hooks {

/// Distance from the surface, in spacings of the point, up to which a point supports it. The
/// warning "coverage.unsupported" uses the same bound.
inline constexpr double support_reach = 3.0;

/// Fills `support` with one number per vertex of the view, from 0 to 1: the part of its area for
/// which there are points (surface::vertex_support). A point represents the square of its
/// spacing, TargetCloud::point_width(); a point farther than support_reach spacings from its place
/// does not count. `faces_of_points` contains the nearest place of each point of the cloud. The
/// first call for a cloud computes its statistics, with `workers`; the result does not depend on
/// them. [step]
void measure_support(const surface::SurfaceView& view, const cloud::TargetCloud& cloud,
                     std::span<const surface::FacePoint> faces_of_points,
                     std::vector<double>& support, Workers* workers = nullptr);

}  // namespace dsc::hooks
