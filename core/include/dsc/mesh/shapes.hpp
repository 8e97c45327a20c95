#pragma once
// Simple solids that label the tets of a generated mesh.

#include <array>
#include <cstdint>
#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <span>

namespace dsc::mesh {

enum class ShapeKind : std::uint8_t { sphere, box, cylinder };
/// What becomes of a tet inside a shape: the shape's label, or 0.
enum class ShapeAction : std::uint8_t { add, cut };
/// When a tet counts as inside: its barycentre strictly is, or all four of its vertices are (the border
/// included).
enum class ShapeRule : std::uint8_t { barycentre, vertices };

/// One shape; which sizes count depends on the kind. Lengths in the mesh's units.
struct Shape {
    ShapeKind shape = ShapeKind::sphere;
    ShapeAction action = ShapeAction::add;
    ShapeRule rule = ShapeRule::barycentre;
    Vec3 centre = Vec3::Zero();
    double radius = 1.0;                   ///< of sphere and cylinder
    Vec3 half_size = Vec3::Constant(1.0);  ///< of a box
    Vec3 axis = Vec3(0, 0, 1);             ///< of a cylinder, any length but 0
    double half_length = 1.0;              ///< of a cylinder, along its axis
    Label label = 1;
};

/// How far outside the shape a point is, negative inside, 0 on the border. Never more in size than the distance
/// to the border.
double excess(const Shape& shape, const Vec3& point);

/// The point of the shape's border nearest to a point; any of the nearest ones where there are several.
Vec3 nearest_on_border(const Shape& shape, const Vec3& point);

/// The shape grown outwards by `by`, corners kept; a negative `by` shrinks it.
Shape grown(Shape shape, double by);

/// A point of the surface between the labels of the shapes near to `point`: the nearest on that border which is not
/// covered by a later shape; where borders meet, one near the crease, found by going to and fro between them, which
/// need not be the very nearest. The point itself without such a border. [parallel]
Vec3 nearest_on_surface(std::span<const Shape> shapes, const Vec3& point);

/// Whether the shape holds a tet, by its rule.
bool holds(const Shape& shape, const std::array<Vec3, 4>& corners);

/// Label of a tet: that of the last shape that holds it, 0 where none does or the last one cuts.
Label label_of(std::span<const Shape> shapes, const std::array<Vec3, 4>& corners);

/// Whether every tet inside the ball certainly has the same label. False near the surface of a shape, unless
/// that surface makes no difference there.
bool same_label_within(std::span<const Shape> shapes, const Vec3& centre, double radius);

}  // namespace dsc::mesh
