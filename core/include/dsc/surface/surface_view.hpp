#pragma once
// The interface as flat arrays: what velocities, curvatures and refinements read.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

/// A snapshot of the interface of a complex. Vertices are in birth order, faces in the order of their least vertex and
/// then of the other two: the same complex gives the same view whatever its slots. Indices below are view indices.
struct SurfaceView {
    std::vector<mesh::VertexId> vertex_ids;       ///< complex vertex of each view vertex
    std::vector<std::uint32_t> births;            ///< birth id of each view vertex, ascending; keys of random streams
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;                    ///< unit, out of the larger label; mean of the unit normals of the faces
                                                  ///< round the vertex; zero where they cancel
    std::vector<std::uint8_t> movable;            ///< 0 on the box and where three labels meet
    std::vector<std::array<std::uint32_t, 3>> faces;  ///< counter-clockwise seen from the smaller label
    std::vector<mesh::TetId> face_tets;           ///< the tet with the larger label behind each face
    std::vector<Vec3> face_normals;               ///< unit
    std::vector<double> face_areas;
    std::vector<std::uint32_t> face_offsets;      ///< faces of vertex i: vertex_faces[face_offsets[i] .. face_offsets[i+1])
    std::vector<std::uint32_t> vertex_faces;
    double mean_edge = 0.0;

    std::size_t vertex_count() const { return vertex_ids.size(); }
    std::size_t face_count() const { return faces.size(); }
    std::span<const std::uint32_t> faces_of(std::size_t vertex) const {
        return std::span(vertex_faces).subspan(face_offsets[vertex], face_offsets[vertex + 1] - face_offsets[vertex]);
    }
};

/// What the last view of a complex found round each vertex. Of one complex only; a new or loaded one gets new memory.
class ViewMemory {
public:
    /// A face of the interface, its vertex of least birth first, and the tet with the larger label behind it.
    struct Face {
        std::array<mesh::VertexId, 3> vertices;
        mesh::TetId tet;
    };

    /// The faces led by the vertex, in the order of a view, if its star is as it was; `known` tells.
    std::span<const Face> faces_led_by(const mesh::Complex& complex, mesh::VertexId v, bool& known) const;
    /// Takes over the faces of a view of this complex, `counts[i]` of them led by vertex i.
    void keep(const mesh::Complex& complex, const SurfaceView& view, std::span<const std::uint32_t> counts);

private:
    std::uint32_t clock_ = 0;                 // of the complex at the view
    std::vector<std::uint32_t> births_;       // of the view's vertices
    std::vector<std::uint32_t> starts_;       // of the faces that vertex i leads
    std::vector<std::uint32_t> index_;        // in the view, by complex vertex; of those that were not in it, anything
    std::vector<Face> faces_;
};

/// Fills `view`, reusing its memory. The cost grows with the interface, not with the volume. `workers`, null for one thread,
/// share the walks. With `memory`, only vertices whose star has changed since the last view are walked round; the view is the
/// same. [step]
void build_view(const mesh::Complex& complex, SurfaceView& view, Workers* workers = nullptr, ViewMemory* memory = nullptr);

/// The label interface of plain arrays as a triangle mesh, points in the order of the arrays; the judge of results,
/// independent of Complex. `vertex_of`, if given, receives each point's index in `mesh.points`.
TriangleMesh extract_interface(const mesh::TetMesh& mesh, std::vector<std::uint32_t>* vertex_of = nullptr);

/// The surface of one label, above 0: all faces between its tets and others, or the outside of the box, counter-clockwise seen
/// from outside. Where more than two labels meet, the interface is no manifold and this still is. `vertex_of` as above.
TriangleMesh extract_phase(const mesh::TetMesh& mesh, mesh::Label phase, std::vector<std::uint32_t>* vertex_of = nullptr);

/// An edge of a view with its faces.
struct ViewEdge {
    std::array<std::uint32_t, 2> vertices;  ///< ascending
    std::array<std::uint32_t, 2> faces;     ///< the two of it with the lowest indices; mesh::none for one that is not there
    std::uint32_t face_count;               ///< 2, but for edges where three labels or more meet, and the rim of open meshes
};

/// All edges, in ascending order of their vertices, to `edges`, reusing its memory. [step]
void build_edges(const SurfaceView& view, std::vector<ViewEdge>& edges);

}  // namespace dsc::surface
