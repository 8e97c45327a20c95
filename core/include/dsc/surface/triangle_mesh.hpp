#pragma once
// A triangle mesh as plain arrays, as surface files contain it.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::surface {

/// Faces are counter-clockwise seen from outside.
struct TriangleMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> faces;     ///< indices into points
    std::vector<std::array<std::uint8_t, 3>> colours{};  ///< empty, or one RGB per point
};

}  // namespace dsc::surface
