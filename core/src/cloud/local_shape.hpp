#pragma once
// The local surface at a point, from its neighbours: its normal without a sign, and the noise.

#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

#include "neighbours.hpp"

namespace dsc::cloud {

/// Per point: the unit vector along which the point and its neighbours spread least. Its sign has
/// no meaning. [setup]
std::vector<Vec3> plane_normals(std::span<const Vec3> points, const Neighbours& neighbours,
                                Workers* workers);

/// Median, over at most 3,000 points, of the root mean square distance of the point and its
/// neighbours from their best-fitting quadric. 0 for fewer than 7 points. [setup]
double quadric_noise(std::span<const Vec3> points, const Neighbours& neighbours, Workers* workers);

}  // namespace dsc::cloud
