#pragma once
// Makes labelled tets from one number per vertex of a lattice: isosurface stuffing
// [LabelleShewchuk2007] that keeps the topology of the signs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::generate {

/// How the interface cuts a lattice. Qualities are those of geometry::tet_quality().
struct StuffOptions {
    /// Largest wanted number of interface vertices; more remain only if no further collapse is
    /// possible.
    std::size_t most_interface_vertices = std::numeric_limits<std::size_t>::max();
    unsigned smoothing_sweeps = 3;
    double cut_low = 0.25, cut_high = 0.75;  ///< range of a cut point along its edge, inside (0, 1)
    double collapse_quality = 0.08;          ///< least quality of all tets that a collapse changes
    double least_quality = 0.05;  ///< least quality of a tet after a vertex moved, unless it was
                                  ///< lower before
};

/// What stuff_interface() did.
struct StuffReport {
    std::size_t mixed_edges = 0;       ///< lattice edges whose ends differ in sign: vertices of the
                                       ///< interface of all cuts
    std::size_t snapped_vertices = 0;  ///< lattice vertices that became interface vertices
    std::size_t refused_snaps = 0;    ///< vertices that were not snapped because the topology would
                                      ///< have changed
    std::size_t cut_vertices = 0;     ///< cut points that remain after snapping
    std::size_t collapsed_edges = 0;  ///< edges of the interface, after cutting
    std::size_t removed_free_vertices = 0;  ///< vertices collapsed onto neighbours, after cutting
    std::size_t interface_vertices = 0;     ///< at the end
    std::size_t interface_faces = 0;        ///< at the end
    std::size_t clipped_moves = 0;  ///< moves that were shortened or not made, to keep the quality
    double least_quality = 1.0;     ///< of all tets at the end
};

/// Cuts tets, which must be positive, conforming and fill a box, along the zero set of `values`
/// (one per point, linear in each tet; positive is inside, label 1; the rest is label 0). The
/// interface has exactly the topology of this zero set, all its vertices are regular, and all tets
/// are positive. Vertices of the result: the points in their order that are still used, then the
/// cut points. Messages use `name` for the generator. Throws ConfigError "stuff.options";
/// GeometryError "stuff.values" for a wrong number of values or a value that is 0 or not finite,
/// "stuff.box" for a positive value on the box; CancelledError. [setup]
mesh::TetMesh stuff_interface(std::span<const Vec3> points,
                              std::span<const std::array<std::uint32_t, 4>> tets,
                              std::span<const double> values, const StuffOptions& options,
                              StuffReport* report, Workers* workers, const CancelToken* cancel,
                              std::string_view name);

/// The same for a lattice whose labels are ignored.
inline mesh::TetMesh stuff_interface(const mesh::TetMesh& lattice, std::span<const double> values,
                                     const StuffOptions& options, StuffReport* report,
                                     Workers* workers, const CancelToken* cancel,
                                     std::string_view name) {
    return stuff_interface(lattice.points, lattice.tets, values, options, report, workers, cancel,
                           name);
}

}  // namespace dsc::generate
