#pragma once
// Initial mesh `corner_box`: a sphere or box joined to the corners of the outer box, with no vertices between them.

#include <dsc/hooks/initial_mesh.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// The initial mesh of the Illinois DSC [Saul2015, ch. 3, figure 3.2]: every vertex of the interface is joined to the nearest
/// corner of the box, whose octant contains it; a vertex on a border of octants is joined to each of their corners. Outside the
/// solid there are only the box's eight vertices.
class CornerBox final : public hooks::InitialMesh {
public:
    enum class Shape { sphere, box };
    struct Params {
        Shape shape = Shape::sphere;
        double radius = 1.0;
        Vec3 half_size = Vec3::Constant(0.8);
        Vec3 centre = Vec3::Zero();
        int divisions = 12;
        double box = 1.5;

        Vec3 extent() const { return shape == Shape::sphere ? Vec3(Vec3::Constant(radius)) : half_size; }
    };
    static void declare(config::ParamSchema<Params>& schema);

    CornerBox(const Params& params, const plugin::Setup& setup);

    /// All tets are positive; the tets of the solid come first and have label 1.
    mesh::TetMesh build(const hooks::InitialMeshContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
