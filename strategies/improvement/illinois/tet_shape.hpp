#pragma once
// The flat shape, one of four, that a tet has or would have if it were pressed flat [Saul2015, ch.
// 3].

#include <array>
#include <cstdint>

#include <dsc/geometry/vec.hpp>

namespace dsc::improvement {

/// Wedge: two vertices nearly coincide. Tee: a vertex lies on an edge of the others. Cap: a vertex
/// lies in the face of the others. Sliver: it lies outside, two opposite edges cross.
enum class FlatClass : std::uint8_t { wedge, tee, cap, sliver };

/// Limits between the classes, in min(longest edge of the tet, L): a small tet is classified by its
/// own size, a tet that extends far, such as those at the corners of a box, by the size of the
/// interface's faces.
struct ShapeLimits {
    double wedge = 0.25;  ///< shortest edge below which a tet is a wedge
    double tee = 0.1;     ///< distance between a vertex and an edge below which a tet is a tee
};

/// Local indices (0 to 3); their meaning depends on the class.
struct TetShape {
    FlatClass flat_class = FlatClass::wedge;
    /// Wedge: the short edge. Tee: the edge that `vertex` lies on. Sliver: the edge of the face
    /// that `vertex` lies beyond; the other edge that crosses it joins `vertex` and `opposite`.
    /// Cap: an edge of the face.
    std::array<std::uint8_t, 2> edge = {0, 1};
    /// Tee: the vertex on the edge. Cap, sliver: the one with the least altitude. Wedge: any that
    /// is not on the edge.
    std::uint8_t vertex = 2;
    std::uint8_t opposite = 3;  ///< the fourth
    double altitude = 0.0;      ///< least distance of a vertex from the plane of the others, in
                                ///< min(longest edge, L)
};

/// Shape of the tet p; `length` is L. Every tet has a shape: the classes are tried in the order of
/// FlatClass, so that they do not overlap and the answer depends on the points alone, not on their
/// order, except for ties. Also finite for coinciding points.
TetShape classify(const std::array<Vec3, 4>& p, double length, const ShapeLimits& limits);

}  // namespace dsc::improvement
