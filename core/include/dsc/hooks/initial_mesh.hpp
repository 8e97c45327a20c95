#pragma once
// Hook `initial_mesh`: makes the labelled box with which a run starts.

#include <string>

#include <dsc/hooks/context.hpp>
#include <dsc/hooks/figures.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::hooks {

/// Reads the files that a generator's parameters name, in any format that the host supports. The
/// host provides it.
class MeshFiles {
public:
    virtual ~MeshFiles();
    /// Returns a labelled tet mesh (.dsc, .vtu) exactly as the file contains it. Throws IoError.
    /// [setup]
    virtual mesh::TetMesh read_volume(const std::string& file) const = 0;
    /// Returns a surface (.obj, .ply, .off, .stl) exactly as the file contains it. Throws IoError.
    /// [setup]
    virtual surface::TriangleMesh read_surface(const std::string& file) const = 0;
};

/// What a generator may read. It is valid until build() returns.
struct InitialMeshContext {
    /// The points, in normalised units. Null when the experiment has no input cloud. [-; -]
    const cloud::TargetCloud* cloud = nullptr;
    /// Seed of the experiment. [1; -]
    std::uint64_t seed = 0;
    /// Stream id of this strategy's place in the experiment: RandomStream(RandomKey{seed, instance,
    /// 0, element}) is the random stream of an element. [1; -]
    std::uint64_t instance = 0;
    /// Says whether the run shall stop: on request, or because its time budget is over. After it
    /// has said so, the answer is discarded. May be null. [-; -]
    const CancelToken* cancel = nullptr;
    /// Reads files that a parameter names. Null if the host reads no files. [-; -]
    const MeshFiles* files = nullptr;
    /// Threads for loops of the strategy, with dsc::for_blocks(). Null: one thread. [-; -]
    Workers* workers = nullptr;
};

/// Returns plain arrays; the kernel validates and adopts them. [setup]
class InitialMesh : public Strategy {
public:
    ~InitialMesh() override;
    virtual mesh::TetMesh build(const InitialMeshContext& context) = 0;
    /// Figures of the mesh that the last build() made, for summary.json.
    virtual Figures figures() const { return {}; }
    /// Warnings about that mesh, for the terminal, summary.json and the report. [setup]
    virtual Warnings warnings() const { return {}; }
    /// CPU seconds of the parts of build(), for summary.json; they differ between runs. [setup]
    virtual Figures seconds() const { return {}; }
};

}  // namespace dsc::hooks
