// Initial mesh `lattice`: a box of cells that are small at the surface of the shapes and larger
// away from it.
//
// The cells are those of a balanced octree; they are filled with a few kinds of well-shaped tets
// [LabelleShewchuk2007]. Tets are labelled by the shapes in their order; all tets at the interface
// are in the finest cells.
#include <vector>

#include <dsc/base/version.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/generate/shape_mesh.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/lattice_params.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/plugin/shape_params.hpp>

namespace {

class Lattice final : public dsc::hooks::InitialMesh {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params : dsc::generate::LatticeOptions, dsc::plugin::ShapeParams {};
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        dsc::plugin::declare_lattice(schema, "the shapes' surface");
        dsc::plugin::declare_shapes(schema);
    }

    Lattice(const Params& params, const dsc::plugin::Setup&)
        : params_(params), shapes_(params.all()) {}

    /// All tets are positive. Throws CancelledError, and ConfigError if a shape reaches the box or
    /// the mesh would be too large.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext& context) override {
        const auto surface = params_.project ? dsc::generate::ShapeSurface::projected
                                             : dsc::generate::ShapeSurface::stepped;
        return dsc::generate::make_shape_mesh(params_, shapes_, "initial mesh 'lattice'", surface,
                                              context.cancel);
    }

private:
    Params params_;
    std::vector<dsc::generate::Shape> shapes_;
};

}  // namespace

DSC_PLUGIN("lattice", DSC_VERSION, "BSD-3-Clause",
           "Start from a graded box of tetrahedra that contains simple shapes") {
    registrar.add<Lattice>(
        "lattice", "a box of cells, fine at the surface of the shapes, coarse away from it");
}
