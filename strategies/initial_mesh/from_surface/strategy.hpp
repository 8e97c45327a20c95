#pragma once
// Initial mesh `from_surface`: a graded box of tets whose interface lies on a closed surface from a file.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/plugin/placing.hpp>
#include <dsc/plugin/plugin.hpp>
#include <optional>
#include <string>

#include "deviation.hpp"
#include "features.hpp"

namespace dsc::strategies {

/// The tets of a lattice are labelled by the solid that the surface bounds, then the vertices of the interface move onto the
/// surface, as far as the tets' quality allows (generate::project_interface).
class FromSurface final : public hooks::InitialMesh {
public:
    struct Params : generate::LatticeOptions {
        Params() { layers = 3; }
        std::string file;
        plugin::Coordinates coordinates = plugin::Coordinates::as_they_are;
        std::optional<double> fit;
        mesh::Label label = 1;
        double tolerance = 1.5;
        double sharp = 40.0;
        int intersections = 0;
    };
    static void declare(config::ParamSchema<Params>& schema);

    FromSurface(const Params& params, const plugin::Setup& setup);

    /// Throws IoError, GeometryError as from_surface::require_solid() and "from_surface.tolerance", ConfigError if the
    /// surface reaches the box or the mesh would be too large, CancelledError.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;
    /// Figures of the fit between mesh and surface; lengths in finest cells.
    hooks::Figures figures() const override { return figures_; }

private:
    surface::TriangleMesh read(const hooks::InitialMeshContext& context) const;
    mesh::TetMesh labelled(const from_surface::Solid& solid, const from_surface::Features& features, const hooks::InitialMeshContext& context) const;
    void judge(const from_surface::Deviation& deviation, double cell) const;

    Params params_;
    hooks::Figures figures_;
};

}  // namespace dsc::strategies
