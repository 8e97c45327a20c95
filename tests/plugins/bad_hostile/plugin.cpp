// Witnesses of mesh.* , cloud.hostile and policy.*: what happens at the edges.
#include <limits>

#include "witness.hpp"

namespace {

using witness::Velocity;

class DividesByNormals final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const dsc::Vec3& n = context().surface.normals[vertex];
        return 0.1 * context().surface.mean_edge * n / n.squaredNorm();
    }
};

class NeedsManyPoints final : public Velocity {
    using Velocity::Velocity;
    dsc::Vec3 displacement(std::size_t vertex) const override {
        const bool lost = context().cloud != nullptr && context().cloud->size() == 1;
        return lost ? dsc::Vec3::Constant(std::numeric_limits<double>::quiet_NaN())
                    : Velocity::displacement(vertex);
    }
};

// A cube of five tets, one of which is missing.
class Gap final : public dsc::hooks::InitialMesh {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    Gap(const Params&, const dsc::plugin::Setup&) {}
    dsc::mesh::TetMesh build(const dsc::hooks::InitialMeshContext&) override {
        dsc::mesh::TetMesh mesh;
        for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
        mesh.tets = {{0, 3, 5, 6}, {1, 0, 5, 3}, {2, 0, 3, 6}, {4, 0, 6, 5}};
        mesh.labels = {1, 0, 0, 0};
        return mesh;
    }
};

class AsksTwice final : public dsc::hooks::RefinementPolicy {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    AsksTwice(const Params&, const dsc::plugin::Setup&) {}
    void refine(const dsc::hooks::RefinementContext& context,
                dsc::hooks::RefinementRequests& out) override {
        if (context.step.surface.face_count() > 0) out.split_faces = {0, 0};
    }
};

class WrongSizing final : public dsc::hooks::RefinementPolicy {
public:
    struct Params {};
    static void declare(dsc::config::ParamSchema<Params>&) {}
    WrongSizing(const Params&, const dsc::plugin::Setup&) {}
    bool owns_sizing() const override { return true; }
    void refine(const dsc::hooks::RefinementContext& context,
                dsc::hooks::RefinementRequests& out) override {
        out.target_lengths.assign(context.step.surface.face_count(),
                                  context.step.surface.mean_edge);
    }
};

}  // namespace

DSC_PLUGIN("bad_hostile", "1.0.0", "MIT", "Witnesses of mesh.*, cloud.hostile and policy.*") {
    registrar.add<DividesByNormals>("mesh_hostile", "divides by the length of a normal");
    registrar.add<NeedsManyPoints>("cloud_hostile", "has no answer for a cloud of one point");
    registrar.add<Gap>("mesh_topology", "leaves a tet out");
    registrar.add<WrongSizing>("policy_sizing", "gives a target length per face");
    registrar.add<AsksTwice>("policy_progress", "asks for the same split twice");
}
