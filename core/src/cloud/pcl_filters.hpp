#pragma once
// PCL's filters on points that were moved to the origin and scaled before the conversion to float.

#include <cstddef>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Indices of the points that stay, ascending. The box of `points` has a diagonal of 1 and is
/// centred at the origin; 0 < neighbours < size.
std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& points,
                                             std::size_t neighbours, double deviations);

/// As above; `radius` is in the units of `points`.
std::vector<std::size_t> radius_inliers(const std::vector<Vec3>& points, double radius,
                                        std::size_t neighbours);

}  // namespace dsc::cloud
