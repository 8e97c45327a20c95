#pragma once
// The parameters by which a generator of initial meshes is told its shapes: one for short, then a list.

#include <dsc/config/params.hpp>
#include <dsc/mesh/shapes.hpp>
#include <type_traits>
#include <vector>

namespace dsc::plugin {

/// Base of the Params of a generator. [setup]
struct ShapeParams {
    /// Short for one shape of label 1: `cube` by barycentres, `sphere` by vertices, as the original's files.
    enum class Preset { cube, sphere, none };
    Preset shape = Preset::cube;
    double half_width = 1.0;
    double radius = 1.0;
    Vec3 centre = Vec3::Zero();
    std::vector<mesh::Shape> shapes;
    bool project = false;

    /// The preset's shape, if any, then the list.
    std::vector<mesh::Shape> all() const;
};

/// Declares the keys of one shape in a list.
void declare_shape(config::ParamSchema<mesh::Shape>& schema);

/// Declares `shape`, `half_width`, `radius`, `centre`, `shapes` and `project` of a Params derived from ShapeParams.
template <class Params>
void declare_shapes(config::ParamSchema<Params>& schema) {
    static_assert(std::is_base_of_v<ShapeParams, Params>);
    using Preset = ShapeParams::Preset;
    schema
        .choice("shape", static_cast<Preset Params::*>(&Params::shape),
                {{"cube", Preset::cube}, {"sphere", Preset::sphere}, {"none", Preset::none}})
        .doc(
            "A first shape of label 1: 'cube' holds tets by their barycentres, 'sphere' those with all four "
            "vertices "
            "inside.");
    schema.real("half_width", static_cast<double Params::*>(&Params::half_width))
        .greater(0)
        .unit("length")
        .doc("Half the edge of shape 'cube'.");
    schema.real("radius", static_cast<double Params::*>(&Params::radius))
        .greater(0)
        .unit("length")
        .doc("Radius of shape 'sphere'.");
    schema.vec3("centre", static_cast<Vec3 Params::*>(&Params::centre))
        .unit("length")
        .doc("Centre of the first shape.");
    schema.list("shapes", static_cast<std::vector<mesh::Shape> Params::*>(&Params::shapes), declare_shape)
        .doc(
            "Further shapes, applied in their order: each gives the tets inside it its label or cuts them "
            "away.");
    schema.boolean("project", static_cast<bool Params::*>(&Params::project))
        .doc(
            "Takes the interface's vertices to the shapes' surface, whatever the shapes' rules say; without it "
            "the interface is made of the lattice's own faces, in steps.");
}

}  // namespace dsc::plugin
