#pragma once
// Initial mesh `lattice`: a box of cells that are small at the surface of the shapes and larger away from it.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/plugin/plugin.hpp>
#include <dsc/plugin/shape_params.hpp>
#include <vector>

namespace dsc::strategies {

/// A balanced octree whose cells are filled with a few kinds of well-shaped tets [LabelleShewchuk2007]. Tets are
/// labelled by the shapes in their order; all tets at the interface are in the finest cells.
class Lattice final : public hooks::InitialMesh {
public:
    struct Params : generate::LatticeOptions, plugin::ShapeParams {};
    static void declare(config::ParamSchema<Params>& schema);

    Lattice(const Params& params, const plugin::Setup& setup);

    /// All tets are positive. Throws CancelledError, and ConfigError if a shape reaches the box or the mesh
    /// would be too large.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;

private:
    Params params_;
    std::vector<generate::Shape> shapes_;
};

}  // namespace dsc::strategies
