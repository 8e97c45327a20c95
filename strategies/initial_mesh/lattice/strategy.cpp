#include "strategy.hpp"

#include <dsc/generate/shape_mesh.hpp>
#include <dsc/plugin/lattice_params.hpp>

namespace dsc::strategies {

void Lattice::declare(config::ParamSchema<Params>& schema) {
    plugin::declare_lattice(schema, "the shapes' surface");
    plugin::declare_shapes(schema);
}

Lattice::Lattice(const Params& params, const plugin::Setup&) : params_(params), shapes_(params.all()) {}

mesh::TetMesh Lattice::build(const hooks::InitialMeshContext& context) {
    const auto surface = params_.project ? generate::ShapeSurface::projected : generate::ShapeSurface::stepped;
    return generate::make_shape_mesh(params_, shapes_, "initial mesh 'lattice'", surface, context.cancel);
}

}  // namespace dsc::strategies
