#include "strategy.hpp"

#include <dsc/mesh/shape_mesh.hpp>
#include <dsc/plugin/lattice_params.hpp>

namespace dsc::strategies {

void Lattice::declare(config::ParamSchema<Params>& schema) {
    plugin::declare_lattice(schema, "the shapes' surface");
    plugin::declare_shapes(schema);
}

Lattice::Lattice(const Params& params, const plugin::Setup&) : params_(params), shapes_(params.all()) {}

mesh::TetMesh Lattice::build(const hooks::InitialMeshContext& context) {
    const auto surface = params_.project ? mesh::ShapeSurface::projected : mesh::ShapeSurface::stepped;
    return mesh::make_shape_mesh(params_, shapes_, "initial mesh 'lattice'", surface, context.cancel);
}

}  // namespace dsc::strategies
