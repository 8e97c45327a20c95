#pragma once
// An order of a cloud's points that does not depend on the order in which they come.

#include <cstddef>
#include <vector>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// Indices of the points, ordered by x, y and z, of equal points by their attributes: colour, normal, area, confidence, and
/// last by the bits of their coordinates, where -0 comes before 0. Points that agree in all of it have no order of their own.
/// The cloud has no NaN among its coordinates. Attributes of a wrong size do not count. [setup]
std::vector<std::size_t> lexicographic_order(const Cloud& cloud);

}  // namespace dsc::cloud
