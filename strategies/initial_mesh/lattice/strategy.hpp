#pragma once
// Initial mesh `lattice`: a box of cells that are small at the shapes' surface and grow away from it.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/plugin/shape_params.hpp>
#include <optional>
#include <vector>

#include "octree.hpp"
#include "tiling.hpp"

namespace dsc::strategies {

/// A balanced octree, its cells filled with tets of a few well-shaped kinds [LabelleShewchuk2007]. Tets are
/// labelled by the shapes in their order; all tets at the labels' border are of the finest cells.
class Lattice final : public hooks::InitialMesh {
public:
    struct Params : plugin::ShapeParams {
        int cells = 30;
        std::optional<double> cell;
        double box = 1.5;
        Vec3 box_centre = Vec3::Zero();
        int layers = 2;
        double growth = 2.0;
        lattice::Pattern finest = lattice::Pattern::parity;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Lattice(const Params& params, const plugin::Setup& setup);

    /// All tets are positive. Throws CancelledError, and ConfigError where a shape reaches the box or the mesh
    /// would become too large.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;

private:
    mesh::TetMesh tiled(const lattice::Frame& frame, unsigned top, std::span<const mesh::Shape> shapes,
                        const CancelToken* cancel) const;

    Params params_;
    std::vector<mesh::Shape> shapes_;
};

}  // namespace dsc::strategies
