#pragma once
// A sphere or a box cut into tets, octant by octant, so that the borders of the octants are edges
// of its surface.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::corner_box {

/// The number of an octant about the centre of a solid: bit a is set if coordinate a is positive.
using Octant = std::uint8_t;

struct SurfaceFace {
    std::array<std::uint32_t, 3> corners;
    Octant octant;
};

/// Tets, not oriented, and their surface.
struct Solid {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> tets;
    std::vector<SurfaceFace> faces;
    /// The vertices where the surface meets the axes: at the positive and at the negative end of
    /// each axis.
    std::array<std::array<std::uint32_t, 2>, 3> poles{};
};

/// n = `divisions` edges lead from the centre to each pole, and n along a quarter of each great
/// circle: 4 n^2 + 2 vertices on the surface, all at `radius`, 8 n^3 tets.
Solid sphere(const Vec3& centre, double radius, unsigned divisions);

/// 2n x 2n x 2n cells of five tets each: 24 n^2 + 2 vertices on the surface, 40 n^3 tets.
Solid box(const Vec3& centre, const Vec3& half_size, unsigned divisions);

}  // namespace dsc::corner_box
