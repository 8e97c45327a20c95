#pragma once
// What a written file is worth: surfaces and volumes measured as they stand on the disk.

#include <dsc/base/workers.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/intersections.hpp>
#include <filesystem>
#include <map>
#include <string>

namespace dsc::run {

struct SurfaceMeasure {
    surface::SurfaceReport report;
    surface::IntersectionReport intersections;

    /// Closed, manifold, oriented, free of self-intersections, of positive volume.
    bool solid() const { return report.closed_manifold() && intersections.count == 0 && report.volume > 0.0; }
};

/// [step]
SurfaceMeasure measure(const surface::TriangleMesh& mesh, Workers* workers = nullptr);

/// A tet mesh by itself, whatever made it.
struct VolumeMeasure {
    std::size_t points = 0;
    std::size_t unused_points = 0;
    std::size_t tets = 0;
    std::size_t invalid_tets = 0;  ///< an index out of range, a repeated vertex or a point that is not finite
    std::size_t inverted_tets = 0;   ///< orient3d not positive: negative or flat
    std::size_t overused_faces = 0;  ///< with more than two tets
    std::size_t folded_faces = 0;    ///< whose two tets lie on the same side
    std::size_t boundary_faces = 0;  ///< with one tet
    std::size_t junction_vertices = 0;  ///< in tets of three labels or more, the outside of the box counting as 0
    double min_quality = 0.0;
    double mean_quality = 0.0;
    double volume = 0.0;  ///< sum over all tets
    double box_volume = 0.0;
    Box3 box;
    std::map<mesh::Label, std::size_t> label_tets;
    std::map<mesh::Label, double> label_volumes;
    surface::TriangleMesh interface;  ///< label interface, empty for a mesh with faults of its tets
    SurfaceMeasure interface_measure;

    /// Every face has one tet or two on opposite sides.
    bool adjacency_valid() const { return invalid_tets == 0 && overused_faces == 0 && folded_faces == 0; }
    /// The tets fill the box of their points, relative 1e-9.
    bool fills_box() const;
    /// Valid tets whose label interface is a solid.
    bool solid() const {
        return adjacency_valid() && inverted_tets == 0 && tets > 0 && interface_measure.solid();
    }
};

/// `with_interface` false: the interface is neither extracted nor measured. [step]
VolumeMeasure measure(const mesh::TetMesh& mesh, Workers* workers = nullptr, bool with_interface = true);

/// Whether two meshes have the same points and faces, bit for bit and in the same order. [parallel]
bool identical(const surface::TriangleMesh& a, const surface::TriangleMesh& b);

}  // namespace dsc::run
