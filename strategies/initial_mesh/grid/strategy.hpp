#pragma once
// Initial mesh `grid`: a box of equal cells, five tets each.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>
#include <vector>

#include "shapes.hpp"

namespace dsc::strategies {

/// Cells alternate between two mirrored patterns of five tets (four corners and a regular one in the middle),
/// so that the diagonals of neighbouring cells agree. Tets are labelled by the shapes in their order.
class Grid final : public hooks::InitialMesh {
public:
    /// Short for one shape round the centre: `cube` by barycentres, `sphere` by vertices, as the original's
    /// files.
    enum class Preset { cube, sphere, none };
    struct Params {
        int cells = 30;
        double box = 1.5;
        Preset shape = Preset::cube;
        double half_width = 1.0;
        double radius = 1.0;
        Vec3 centre = Vec3::Zero();
        std::vector<grid::Shape> shapes;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Grid(const Params& params, const plugin::Setup& setup);

    /// Vertex (i, j, k) has index i + j (N+1) + k (N+1)^2; cells come with k outermost, then j, then i; all
    /// tets are positive. Throws CancelledError.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;

private:
    mesh::Label label_of(const std::array<Vec3, 4>& corners) const;

    int cells_;
    double box_;
    std::vector<grid::Shape> shapes_;
};

}  // namespace dsc::strategies
