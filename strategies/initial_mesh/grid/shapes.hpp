#pragma once
// The shapes that a grid is labelled by.

#include <array>
#include <cstdint>
#include <dsc/config/params.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::strategies::grid {

enum class ShapeKind { sphere, box, cylinder };
/// What becomes of a tet inside a shape: the shape's label, or 0.
enum class Action { add, cut };
/// When a tet counts as inside: its barycentre strictly is, or all four of its vertices are (the border
/// included).
enum class Rule { barycentre, vertices };

/// One shape; which sizes count depends on the kind.
struct Shape {
    ShapeKind shape = ShapeKind::sphere;
    Action action = Action::add;
    Rule rule = Rule::barycentre;
    Vec3 centre = Vec3::Zero();
    double radius = 1.0;                   ///< of sphere and cylinder
    Vec3 half_size = Vec3::Constant(1.0);  ///< of a box
    Vec3 axis = Vec3(0, 0, 1);             ///< of a cylinder, any length
    double half_length = 1.0;              ///< of a cylinder, along its axis
    std::int32_t label = 1;
};

/// Declares the keys of one shape in a list.
void declare_shape(config::ParamSchema<Shape>& schema);

/// Whether the shape holds a tet, by its rule.
bool holds(const Shape& shape, const std::array<Vec3, 4>& corners);

}  // namespace dsc::strategies::grid
