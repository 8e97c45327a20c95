#pragma once
// Initial mesh `grid`: a box of equal cells, five tets each.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/plugin/shape_params.hpp>
#include <vector>

namespace dsc::strategies {

/// Cells alternate between two mirrored patterns of five tets (four corners and a regular one in the middle),
/// so that the diagonals of neighbouring cells agree. Tets are labelled by the shapes in their order; their interface is
/// stair-stepped, or projected onto the surface of the shapes.
class Grid final : public hooks::InitialMesh {
public:
    struct Params : plugin::ShapeParams {
        int cells = 30;
        double box = 1.5;
        Vec3 box_centre = Vec3::Zero();
    };
    static void declare(config::ParamSchema<Params>& schema);

    Grid(const Params& params, const plugin::Setup& setup);

    /// Not projected: vertex (i, j, k) has index i + j (N+1) + k (N+1)^2; cells come with k outermost, then j, then i; all
    /// tets are positive. Throws CancelledError.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;

private:
    mesh::TetMesh lattice(const hooks::InitialMeshContext& context,
                          std::span<const generate::Shape> shapes) const;

    int cells_;
    double box_;
    Vec3 box_centre_;
    bool project_;
    std::vector<generate::Shape> shapes_;
};

}  // namespace dsc::strategies
