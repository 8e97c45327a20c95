#include "strategy.hpp"

namespace dsc::strategies {

void DscFile::declare(config::ParamSchema<Params>& schema) {
    schema.file("file", &Params::file)
        .required()
        .extensions({".dsc", ".vtu"})
        .doc("A labelled tet mesh that fills a box: of the original's .dsc files, of a former run, or of your own.");
    plugin::declare_coordinates(schema, &Params::coordinates);
}

DscFile::DscFile(const Params& params, const plugin::Setup&) : params_(params) {}

mesh::TetMesh DscFile::build(const hooks::InitialMeshContext& context) {
    mesh::TetMesh mesh = plugin::require_files(context).read_volume(params_.file);
    plugin::place(mesh.points, params_.coordinates, context);
    return mesh;
}

}  // namespace dsc::strategies
