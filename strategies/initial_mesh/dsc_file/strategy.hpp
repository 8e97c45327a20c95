#pragma once
// Initial mesh `dsc_file`: a labelled box of tets from a file.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/placing.hpp>
#include <dsc/plugin/plugin.hpp>
#include <string>

namespace dsc::strategies {

/// The mesh of the file, with any number of labels. It must fill an axis-parallel box; the kernel re-orients its
/// tets, makes pinched vertices regular and refuses a mesh that is not a complex.
class DscFile final : public hooks::InitialMesh {
public:
    struct Params {
        std::string file;
        plugin::Coordinates coordinates = plugin::Coordinates::as_they_are;
    };
    static void declare(config::ParamSchema<Params>& schema);

    DscFile(const Params& params, const plugin::Setup& setup);

    /// Throws IoError.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
