// The keys of one shape in a list, and the list of all shapes of a generator.
#include "dsc/plugin/shape_params.hpp"

namespace dsc::plugin {

using generate::Shape;
using generate::ShapeAction;
using generate::ShapeKind;
using generate::ShapeRule;

std::vector<Shape> ShapeParams::all() const {
    std::vector<Shape> list;
    if (shape != Preset::none) {
        Shape& first = list.emplace_back();
        first.centre = centre;
        if (shape == Preset::cube) {
            first.shape = ShapeKind::box;
            first.half_size = Vec3::Constant(half_width);
        } else {
            first.radius = radius;
            first.rule = ShapeRule::vertices;
        }
    }
    list.insert(list.end(), shapes.begin(), shapes.end());
    return list;
}

void declare_shape(config::ParamSchema<Shape>& schema) {
    schema
        .choice("shape", &Shape::shape,
                {{"sphere", ShapeKind::sphere},
                 {"box", ShapeKind::box},
                 {"cylinder", ShapeKind::cylinder}})
        .doc("Kind of shape; a cylinder has flat ends.");
    schema.choice("action", &Shape::action, {{"add", ShapeAction::add}, {"cut", ShapeAction::cut}})
        .doc("'add' gives the label of the shape to the tets inside it, 'cut' gives them label 0.");
    schema
        .choice("rule", &Shape::rule,
                {{"barycentre", ShapeRule::barycentre}, {"vertices", ShapeRule::vertices}})
        .doc("A tet is inside if its barycentre is inside, or only if all four of its vertices are "
             "inside.");
    schema.vec3("centre", &Shape::centre).unit("length").doc("The shape's centre.");
    schema.real("radius", &Shape::radius)
        .greater(0, "length")
        .doc("Radius of a sphere or a cylinder.");
    schema.vec3("half_size", &Shape::half_size)
        .greater(0, "length")
        .doc("Half the edges of a box along the coordinate axes.");
    schema.vec3("axis", &Shape::axis)
        .unit("dimensionless")
        .doc("Direction of a cylinder's axis; its length does not matter.");
    schema.real("half_length", &Shape::half_length)
        .greater(0, "length")
        .doc("Half the length of a cylinder.");
    schema.integer("label", &Shape::label).range(1, 1000).doc("Label that 'add' gives.");
    schema.check([](const Shape& s) { return s.axis.norm() > 1e-9; },
                 "axis must not be the zero vector");
}

}  // namespace dsc::plugin
