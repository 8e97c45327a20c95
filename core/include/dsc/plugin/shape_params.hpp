#pragma once
// The parameters that describe the shapes of a generator of initial meshes: a preset for one shape,
// and a list.

#include <type_traits>
#include <vector>

#include <dsc/config/params.hpp>
#include <dsc/generate/shapes.hpp>

namespace dsc::plugin {

/// Base of the Params of a generator. [setup]
struct ShapeParams {
    /// Preset for one shape of label 1: `cube` by barycentres, `sphere` by vertices, as in the
    /// files of the original program.
    enum class Preset { cube, sphere, none };
    Preset shape = Preset::cube;
    double half_width = 1.0;
    double radius = 1.0;
    Vec3 centre = Vec3::Zero();
    std::vector<generate::Shape> shapes;
    bool project = false;

    /// The preset's shape if there is one, then the list.
    std::vector<generate::Shape> all() const;
};

/// Declares the keys of one shape in a list.
void declare_shape(config::ParamSchema<generate::Shape>& schema);

/// Declares `shape`, `half_width`, `radius`, `centre`, `shapes` and `project` of a Params derived
/// from ShapeParams.
template <class Params>
void declare_shapes(config::ParamSchema<Params>& schema) {
    static_assert(std::is_base_of_v<ShapeParams, Params>);
    using Preset = ShapeParams::Preset;
    schema
        .choice("shape", static_cast<Preset Params::*>(&Params::shape),
                {{"cube", Preset::cube}, {"sphere", Preset::sphere}, {"none", Preset::none}})
        .doc("A first shape of label 1: 'cube' contains the tets whose barycentre is inside, "
             "'sphere' those with all four vertices inside.");
    schema.real("half_width", static_cast<double Params::*>(&Params::half_width))
        .greater(0, "length")
        .doc("Half the edge of shape 'cube'.");
    schema.real("radius", static_cast<double Params::*>(&Params::radius))
        .greater(0, "length")
        .doc("Radius of shape 'sphere'.");
    schema.vec3("centre", static_cast<Vec3 Params::*>(&Params::centre))
        .unit("length")
        .doc("Centre of the first shape.");
    schema
        .list("shapes", static_cast<std::vector<generate::Shape> Params::*>(&Params::shapes),
              declare_shape)
        .doc("Further shapes, applied in order: each gives its label to the tets inside it or cuts "
             "them away.");
    schema.boolean("project", static_cast<bool Params::*>(&Params::project))
        .doc("Moves the vertices of the interface onto the surface of the shapes, for every rule; "
             "without it the interface consists of faces of the lattice and is stepped.");
}

}  // namespace dsc::plugin
