#pragma once
// From a file's or generator's arrays to a valid complex, or a refusal that names the first offender.

#include <string_view>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// What adopt() changed.
struct AdoptReport {
    std::size_t reoriented_tets = 0;
    std::size_t dropped_vertices = 0;    ///< used by no tet
    std::size_t unpinched_vertices = 0;  ///< vertices split or groups relabelled so that every phase bounds a 2-manifold
    std::size_t vanished_components = 0; ///< below `min_component`
};

/// Re-orients tets, drops unused vertices, unpinches, removes components under `min_component` regular tets of the mean
/// interface edge. Throws GeometryError (exit 5) naming the first element and the count: index out of range, zero
/// volume, a face with more than two tets, two tets on one side of a face, volumes that do not add up to the box
/// (relative 1e-9), a vertex that cannot be unpinched. `name` is the file or generator named in messages. `workers`, null
/// for one thread, share the work. [setup]
Complex adopt(const TetMesh& mesh, std::string_view name, AdoptReport* report = nullptr, double min_component = 2.0,
              Workers* workers = nullptr);

/// Makes the tets of negative volume positive, as some programs' files need; returns their number. Indices must be in range.
/// [setup]
std::size_t orient(TetMesh& mesh);

}  // namespace dsc::mesh
