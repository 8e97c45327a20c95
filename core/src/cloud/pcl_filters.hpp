#pragma once
// PCL's filters; see pcl_backend.hpp.

#include <cstddef>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

std::vector<std::size_t> statistical_inliers(const std::vector<Vec3>& points,
                                             std::size_t neighbours, double deviations);
std::vector<std::size_t> radius_inliers(const std::vector<Vec3>& points, double radius,
                                        std::size_t neighbours);

}  // namespace dsc::cloud
