#pragma once
// A point cloud in double precision.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// Points in the units of their file. No normals are used anywhere.
struct Cloud {
    std::vector<Vec3> points;
    std::vector<Colour> colours{};  ///< empty, or one a point
    std::string source{};  ///< the file or shape that they come from, named in error messages; may be empty
};

}  // namespace dsc::cloud
