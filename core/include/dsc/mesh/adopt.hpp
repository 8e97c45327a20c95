#pragma once
// Turns the arrays of a file or generator into a valid complex, or refuses them with the first
// fault (method.md, section 1.3).

#include <string_view>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// What adopt() changed.
struct AdoptReport {
    std::size_t reoriented_tets = 0;
    std::size_t dropped_vertices = 0;     ///< vertices that no tet used
    std::size_t unpinched_vertices = 0;   ///< vertices split or groups relabelled so that every
                                          ///< phase bounds a 2-manifold
    std::size_t vanished_components = 0;  ///< components smaller than `min_component`
};

/// Orients tets, drops unused vertices, unpinches, and removes components below `min_component`
/// regular tets of the mean interface edge. Throws GeometryError (exit code 5) that names the first
/// element and the count: index out of range, zero volume, a face with more than two tets, two tets
/// on one side of a face, a sum of volumes that differs from the volume of the box by more than a
/// relative 1e-9, a vertex that cannot be unpinched. Messages use `name` for the file or generator.
/// `workers`, null for one thread, share the work. Move a mesh that is not needed any more: its
/// memory is given back on the way. [setup]
Complex adopt(TetMesh mesh, std::string_view name, AdoptReport* report = nullptr,
              double min_component = 2.0, Workers* workers = nullptr);

/// Makes the tets of negative volume positive, because some programs write such files; returns
/// their number. Indices must be in range. [setup]
std::size_t orient(TetMesh& mesh);

}  // namespace dsc::mesh
