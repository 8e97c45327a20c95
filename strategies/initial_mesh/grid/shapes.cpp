#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dsc::strategies::grid {
namespace {

// How far outside the shape a point is, negative inside; its sign is all that counts.
double excess(const Shape& shape, const Vec3& point) {
    const Vec3 p = point - shape.centre;
    switch (shape.shape) {
        case ShapeKind::sphere:
            return p.norm() - shape.radius;
        case ShapeKind::box:
            return (p.cwiseAbs() - shape.half_size).maxCoeff();
        case ShapeKind::cylinder: {
            const Vec3 axis = shape.axis.normalized();
            const double along = p.dot(axis);
            return std::max((p - along * axis).norm() - shape.radius, std::abs(along) - shape.half_length);
        }
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace

void declare_shape(config::ParamSchema<Shape>& schema) {
    schema
        .choice("shape", &Shape::shape,
                {{"sphere", ShapeKind::sphere}, {"box", ShapeKind::box}, {"cylinder", ShapeKind::cylinder}})
        .doc("What it is; a cylinder ends flat.");
    schema.choice("action", &Shape::action, {{"add", Action::add}, {"cut", Action::cut}})
        .doc("'add' gives the tets inside the shape's label, 'cut' gives them label 0.");
    schema.choice("rule", &Shape::rule, {{"barycentre", Rule::barycentre}, {"vertices", Rule::vertices}})
        .doc("A tet is inside when its barycentre is, or only when all four of its vertices are.");
    schema.vec3("centre", &Shape::centre).unit("length").doc("The shape's centre.");
    schema.real("radius", &Shape::radius).greater(0).unit("length").doc("Radius of a sphere or a cylinder.");
    schema.vec3("half_size", &Shape::half_size)
        .greater(0)
        .unit("length")
        .doc("Half the edges of a box along the coordinate axes.");
    schema.vec3("axis", &Shape::axis)
        .unit("1")
        .doc("Direction of a cylinder's axis; its length does not matter.");
    schema.real("half_length", &Shape::half_length)
        .greater(0)
        .unit("length")
        .doc("Half the length of a cylinder.");
    schema.integer("label", &Shape::label).range(1, 1000).doc("Label that 'add' gives.");
    schema.check([](const Shape& s) { return s.axis.norm() > 1e-9; }, "axis must not be the zero vector");
}

bool holds(const Shape& shape, const std::array<Vec3, 4>& corners) {
    if (shape.rule == Rule::barycentre) {
        return excess(shape, 0.25 * (corners[0] + corners[1] + corners[2] + corners[3])) < 0;
    }
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& p) { return excess(shape, p) <= 0; });
}

}  // namespace dsc::strategies::grid
