#pragma once
// The readers that a host passes to generators of initial meshes.

#include <dsc/hooks/initial_mesh.hpp>

namespace dsc::run {

/// Every format of the io module. [setup]
class MeshFiles final : public hooks::MeshFiles {
public:
    mesh::TetMesh read_volume(const std::string& file) const override;
    surface::TriangleMesh read_surface(const std::string& file) const override;
};

}  // namespace dsc::run
