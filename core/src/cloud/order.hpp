#pragma once
// An order of a cloud's points that does not depend on the order of the input.

#include <cstddef>
#include <vector>

#include <dsc/cloud/cloud.hpp>

namespace dsc::cloud {

/// Indices of the points, ordered by x, y and z; equal points by their attributes: colour, normal,
/// area, confidence; finally by the bits of their coordinates, where -0 comes before 0. Points that
/// agree in all this have no defined order. Coordinates must not be NaN. Attributes of a wrong size
/// are ignored. [setup]
std::vector<std::size_t> lexicographic_order(const Cloud& cloud);

}  // namespace dsc::cloud
