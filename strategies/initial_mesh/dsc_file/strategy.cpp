#include "strategy.hpp"

namespace dsc::strategies {

void DscFile::declare(config::ParamSchema<Params>& schema) {
    schema.file("file", &Params::file)
        .required()
        .extensions({".dsc", ".vtu"})
        .doc("Labelled tet mesh that fills a box: a .dsc file of the original program, the result of a former run, or your "
             "own file.");
    plugin::declare_coordinates(schema, &Params::coordinates);
}

DscFile::DscFile(const Params& params, const plugin::Setup&) : params_(params) {}

mesh::TetMesh DscFile::build(const hooks::InitialMeshContext& context) {
    mesh::TetMesh mesh = plugin::require_files(context).read_volume(params_.file);
    plugin::place(mesh.points, params_.coordinates, context);
    return mesh;
}

}  // namespace dsc::strategies
