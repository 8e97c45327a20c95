#pragma once
// Support: for which part of a vertex' area there are points.

#include <span>
#include <vector>

#include <dsc/surface/face_points.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

/// Fills `support` with one number per vertex of the view, from 0 to 1: the area that the points
/// near the vertex represent, divided by the vertex' area, which is a third of the areas of its
/// faces; at most 1. `places` is the nearest place of each point and `areas` the area that each
/// point represents, 0 or less for a point that does not count. A point counts for each corner of
/// its face with the barycentric weight of the corner, so it does not matter which face a point
/// gets that is nearest to an edge. Sizes of `places` and `areas` are equal. [step]
void vertex_support(const SurfaceView& view, std::span<const FacePoint> places,
                    std::span<const double> areas, std::vector<double>& support);

}  // namespace dsc::surface
