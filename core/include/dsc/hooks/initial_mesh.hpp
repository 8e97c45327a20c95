#pragma once
// Hook `initial_mesh`: the labelled box that a run starts from.

#include <string>

#include <dsc/hooks/context.hpp>
#include <dsc/hooks/figures.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::hooks {

/// Reads the files that a generator's parameters name, in any format that the host knows; the host brings it.
class MeshFiles {
public:
    virtual ~MeshFiles();
    /// A labelled tet mesh (.dsc, .vtu), as it is in the file. Throws IoError. [setup]
    virtual mesh::TetMesh read_volume(const std::string& file) const = 0;
    /// A surface (.obj, .ply, .off, .stl), as it is in the file. Throws IoError. [setup]
    virtual surface::TriangleMesh read_surface(const std::string& file) const = 0;
};

/// What a generator may look at.
struct InitialMeshContext {
    const cloud::TargetCloud* cloud = nullptr;
    std::uint64_t seed = 0;
    std::uint64_t instance = 0;
    const CancelToken* cancel = nullptr;
    const MeshFiles* files = nullptr;  ///< null where the host reads no files
    Workers* workers = nullptr;        ///< for loops of its own (dsc::for_blocks); null: one thread
};

/// Returns plain arrays; the kernel validates and adopts them. [setup]
class InitialMesh : public Strategy {
public:
    ~InitialMesh() override;
    virtual mesh::TetMesh build(const InitialMeshContext& context) = 0;
    /// What there is to say about the mesh that build() made last, for summary.json.
    virtual Figures figures() const { return {}; }
    /// What is doubtful about it, for the terminal, summary.json and the report. [setup]
    virtual Warnings warnings() const { return {}; }
    /// CPU seconds of the parts of build(), for summary.json; they differ from run to run. [setup]
    virtual Figures seconds() const { return {}; }
};

}  // namespace dsc::hooks
