// Initial mesh `dsc_file`: a labelled box of tets from a file.
//
// The mesh may contain any number of labels. It must fill an axis-parallel box; the kernel
// re-orients its tets, makes pinched vertices regular and refuses a mesh that is not a complex.
#include <string>

#include <dsc/base/version.hpp>
#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/coordinates.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class DscFile final : public dsc::hooks::InitialMesh {
public:
    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        std::string file;
        dsc::plugin::Coordinates coordinates = dsc::plugin::Coordinates::as_they_are;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.file("file", &Params::file)
            .required()
            .extensions({".dsc", ".vtu"})
            .doc("Labelled tet mesh that fills a box: a .dsc file of the original program, the "
                 "result of a former run, or your own file.");
        dsc::plugin::declare_coordinates(schema, &Params::coordinates);
    }

    DscFile(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    /// Throws IoError.
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext& context) override {
        dsc::mesh::TetMesh mesh = dsc::plugin::require_files(context).read_volume(params_.file);
        dsc::plugin::place(mesh.points, params_.coordinates, context);
        return mesh;
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("dsc_file", DSC_VERSION, "BSD-3-Clause", "Start from a labelled tet mesh in a file") {
    registrar.add<DscFile>("dsc_file", "a labelled box of tets from a .dsc or .vtu file");
}
