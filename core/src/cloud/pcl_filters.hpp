#pragma once
// PCL's filters on points that were moved to the origin and scaled before they became floats.

#include <cstddef>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Indices of the points that stay, ascending. `points` have a box of diagonal 1 round the origin; 0 <
/// neighbours < size.
std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& points, std::size_t neighbours,
                                             double deviations);

/// As above; `radius` in the units of `points`.
std::vector<std::size_t> radius_inliers(const std::vector<Vec3>& points, double radius,
                                        std::size_t neighbours);

}  // namespace dsc::cloud
