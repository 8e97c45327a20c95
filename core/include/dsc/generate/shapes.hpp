#pragma once
// Simple solids that define the labels of a generated mesh.

#include <array>
#include <cstdint>
#include <span>

#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::generate {

enum class ShapeKind : std::uint8_t { sphere, box, cylinder };
/// What happens to a tet inside a shape: it gets the shape's label (add) or 0 (cut).
enum class ShapeAction : std::uint8_t { add, cut };
/// When a tet counts as inside: if its barycentre is strictly inside, or if all four of its
/// vertices are inside or on the border.
enum class ShapeRule : std::uint8_t { barycentre, vertices };

/// One shape; the kind decides which sizes apply. Lengths are in the mesh's units.
struct Shape {
    ShapeKind shape = ShapeKind::sphere;
    ShapeAction action = ShapeAction::add;
    ShapeRule rule = ShapeRule::barycentre;
    Vec3 centre = Vec3::Zero();
    double radius = 1.0;                   ///< of sphere and cylinder
    Vec3 half_size = Vec3::Constant(1.0);  ///< of a box
    Vec3 axis = Vec3(0, 0, 1);             ///< of a cylinder; any length but 0
    double half_length = 1.0;              ///< of a cylinder, along its axis
    mesh::Label label = 1;
};

/// How far a point is outside the shape: negative inside, 0 on the border. The absolute value is
/// never larger than the distance to the border.
double excess(const Shape& shape, const Vec3& point);

/// The point of the shape's border nearest to a point; any of them if several are equally near.
Vec3 nearest_on_border(const Shape& shape, const Vec3& point);

/// The shape grown outwards by `by`, with its corners kept; a negative `by` shrinks it.
Shape grown(Shape shape, double by);

/// A point near `point` on the surface between the labels of the shapes: the nearest point of the
/// borders that no later shape covers. Where borders meet, it is a point near the crease, found by
/// alternating projections, and not always the nearest one. Without any border it is the point
/// itself. [parallel]
Vec3 nearest_on_surface(std::span<const Shape> shapes, const Vec3& point);

/// Whether a tet counts as inside the shape, by its rule.
bool holds(const Shape& shape, const std::array<Vec3, 4>& corners);

/// Label of a tet: the label of the last shape that contains it; 0 if no shape contains it or the
/// last one cuts.
mesh::Label label_of(std::span<const Shape> shapes, const std::array<Vec3, 4>& corners);

/// Whether every tet inside the ball certainly has the same label. False near the surface of a
/// shape, unless that surface has no effect there.
bool same_label_within(std::span<const Shape> shapes, const Vec3& centre, double radius);

}  // namespace dsc::generate
