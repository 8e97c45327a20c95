#pragma once
// What the neighbours of a point say about the surface there: its normal without a sign, and the noise.

#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

#include "neighbours.hpp"

namespace dsc::cloud {

/// Per point: the unit vector along which the point and its neighbours spread least. Its sign means nothing. [setup]
std::vector<Vec3> plane_normals(std::span<const Vec3> points, const Neighbours& neighbours, Workers* workers);

/// Median, over 3,000 points at most, of the root mean square distance of the point and its neighbours from the quadric that
/// fits them best. 0 where there are fewer than 7 points. [setup]
double quadric_noise(std::span<const Vec3> points, const Neighbours& neighbours, Workers* workers);

}  // namespace dsc::cloud
