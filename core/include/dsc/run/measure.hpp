#pragma once
// Measures surfaces and volumes as their files contain them.

#include <map>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/intersections.hpp>

namespace dsc::run {

struct SurfaceMeasure {
    surface::SurfaceReport report;
    surface::IntersectionReport intersections;

    /// Closed, manifold, oriented, without self-intersections, of positive volume.
    bool solid() const {
        return report.closed_manifold() && intersections.count == 0 && report.volume > 0.0;
    }
};

/// Measures a surface. [step]
SurfaceMeasure measure(const surface::TriangleMesh& mesh, Workers* workers = nullptr);

/// Figures of a tet mesh, independent of how it was made.
struct VolumeMeasure {
    std::size_t points = 0;
    std::size_t unused_points = 0;
    std::size_t tets = 0;
    std::size_t invalid_tets = 0;   ///< an index out of range, a repeated vertex or a point that is
                                    ///< not finite
    std::size_t inverted_tets = 0;  ///< orient3d not positive: negative or flat
    std::size_t overused_faces = 0;     ///< with more than two tets
    std::size_t folded_faces = 0;       ///< faces whose two tets lie on the same side
    std::size_t boundary_faces = 0;     ///< with one tet
    std::size_t junction_vertices = 0;  ///< vertices in tets of three labels or more; the outside
                                        ///< of the box counts as label 0
    double min_quality = 0.0;
    double mean_quality = 0.0;
    double volume = 0.0;  ///< sum over all tets
    double box_volume = 0.0;
    Box3 box;
    std::map<mesh::Label, std::size_t> label_tets;
    std::map<mesh::Label, double> label_volumes;
    surface::TriangleMesh interface;  ///< label interface; empty if tets are faulty
    SurfaceMeasure interface_measure;

    /// Every face has one tet, or two on opposite sides.
    bool adjacency_valid() const {
        return invalid_tets == 0 && overused_faces == 0 && folded_faces == 0;
    }
    /// The tets fill the box of their points, relative 1e-9.
    bool fills_box() const;
    /// Valid tets whose label interface is a solid.
    bool solid() const {
        return adjacency_valid() && inverted_tets == 0 && tets > 0 && interface_measure.solid();
    }
};

/// Measures a volume. `with_interface` false: the interface is neither extracted nor measured.
/// [step]
VolumeMeasure measure(const mesh::TetMesh& mesh, Workers* workers = nullptr,
                      bool with_interface = true);

/// Whether two meshes have the same points and faces, bit for bit and in the same order. [parallel]
bool identical(const surface::TriangleMesh& a, const surface::TriangleMesh& b);

}  // namespace dsc::run
