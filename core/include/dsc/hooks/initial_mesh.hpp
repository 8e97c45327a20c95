#pragma once
// Hook `initial_mesh`: the labelled box that a run starts from.

#include <dsc/hooks/context.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::hooks {

/// What a generator may look at.
struct InitialMeshContext {
    const cloud::TargetCloud* cloud = nullptr;
    std::uint64_t seed = 0;
    std::uint64_t instance = 0;
    const CancelToken* cancel = nullptr;
};

/// Returns plain arrays; the kernel validates and adopts them. [setup]
class InitialMesh : public Strategy {
public:
    ~InitialMesh() override;
    virtual mesh::TetMesh build(const InitialMeshContext& context) = 0;
};

}  // namespace dsc::hooks
