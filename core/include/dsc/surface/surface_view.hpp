#pragma once
// The interface as flat arrays, which velocities, curvatures and refinements read.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

/// A snapshot of the interface of a complex. Vertices are in birth order; faces are in the order of
/// their least vertex and then of the other two. The same complex gives the same view, whatever its
/// slots. Indices are view indices, from 0; they change with every step and refinement, birth ids
/// do not. In a run a view is valid during the call that gets it; a velocity or curvature may use
/// the view of its last prepare() until the end of the step.
struct SurfaceView {
    /// Vertex of the complex; see VolumeView. [V; id]
    std::vector<mesh::VertexId> vertex_ids;
    /// Birth id of each vertex, ascending: its number in the order of creation. It belongs to the
    /// vertex as long as the vertex exists and is never used again; use it for random streams and
    /// for state per vertex. [V; id]
    std::vector<std::uint32_t> births;
    /// Positions of the vertices. [V x 3; n]
    std::vector<Vec3> positions;
    /// Unit normals that point out of the larger label: means of the unit normals of the faces
    /// round the vertices; zero if they cancel. [V x 3; -]
    std::vector<Vec3> normals;
    /// 1 if the kernel moves the vertex, 0 on the box and where three labels or more meet. [V; -]
    std::vector<std::uint8_t> movable;
    /// Vertices of each face, counter-clockwise seen from the smaller label. [F x 3; index]
    std::vector<std::array<std::uint32_t, 3>> faces;
    /// The tet with the larger label behind each face. [F; id]
    std::vector<mesh::TetId> face_tets;
    /// Unit normals of the faces, which point out of the larger label; zero for a face without
    /// area. [F x 3; -]
    std::vector<Vec3> face_normals;
    /// Areas of the faces. [F; n^2]
    std::vector<double> face_areas;
    /// The faces round vertex i are the entries of vertex_faces from number face_offsets[i] to
    /// number face_offsets[i+1] - 1. [V+1; index]
    std::vector<std::uint32_t> face_offsets;
    /// Faces round the vertices, ascending for each vertex; see faces_of(). [3 F; index]
    std::vector<std::uint32_t> vertex_faces;
    /// Mean length of the edges, each counted once per face. [1; n]
    double mean_edge = 0.0;
    /// Labels on the two sides of each face: first the smaller one, into which the face's normal
    /// points, then the larger one, which is that of `face_tets`. The outside of the box has label
    /// 0. [F x 2; label]
    std::vector<std::array<mesh::Label, 2>> face_labels;

    /// Position of each vertex at the start of the last step. positions - previous_positions is the
    /// motion since then, including the motion of a refinement after the step. Before the first
    /// step, and for a vertex that was not on the interface at the start of the last step, it is
    /// the present position. [V x 3; n]
    std::vector<Vec3> previous_positions;
    /// 1 if the vertex reached its destination in the last step, 0 if the kernel dropped a part of
    /// its motion. It is also 1 for vertices that had no destination: those made since, those
    /// without a displacement, and those that were not movable. If a destination is outside the box
    /// shrunk by 2 L, the kernel first moves it to the border of the shrunk box. [V; -]
    std::vector<std::uint8_t> arrived;
    /// Number of steps completed since the vertex was made: 0 for a vertex that the last step or a
    /// refinement after it made. The vertices of the initial mesh are made before step 1. [V;
    /// steps]
    std::vector<std::uint32_t> age;

    /// Number of vertices, V. [1; -]
    std::size_t vertex_count() const { return vertex_ids.size(); }
    /// Number of faces, F. [1; -]
    std::size_t face_count() const { return faces.size(); }
    /// The faces round a vertex, ascending. [number of these faces; index]
    std::span<const std::uint32_t> faces_of(std::size_t vertex) const {
        return std::span(vertex_faces)
            .subspan(face_offsets[vertex], face_offsets[vertex + 1] - face_offsets[vertex]);
    }
    /// Positions of the three corners of a face, counter-clockwise as in `faces`. The first one is
    /// the position of the given vertex. [3 x 3; n]
    std::array<Vec3, 3> corners_from(std::size_t vertex, std::uint32_t face) const {
        const auto& f = faces[face];
        const std::size_t k = f[0] == vertex ? 0 : f[1] == vertex ? 1 : 2;
        return {positions[f[k]], positions[f[(k + 1) % 3]], positions[f[(k + 2) % 3]]};
    }
};

/// What the last view of a complex found round each vertex, and the arrays that build_view()
/// reuses. It belongs to one complex; a new or loaded complex needs a new memory.
class ViewMemory {
public:
    /// A face of the interface, its vertex of least birth first, and the tet with the larger label
    /// behind it.
    struct Face {
        std::array<mesh::VertexId, 3> vertices;
        mesh::TetId tet;
        std::array<mesh::Label, 2> labels;  ///< as SurfaceView::face_labels
    };

    /// The faces that the vertex leads, in the order of a view, if no tet of its star was made,
    /// removed or relabelled; `known` says whether. `i` is its index in the last view; any number
    /// if it was not there.
    std::span<const Face> faces_led_by(const mesh::Complex& complex, mesh::VertexId v,
                                       std::uint32_t i, bool& known) const;
    /// Whether the view is the last one, and only positions have changed since then.
    bool only_moved(const mesh::Complex& complex, const SurfaceView& view) const;
    /// Stores the faces of a view of this complex; vertex i leads `counts[i]` of them. `workers` is
    /// null for one thread.
    void keep(const mesh::Complex& complex, const SurfaceView& view,
              std::span<const std::uint32_t> counts, Workers* workers);

    /// Only positions have changed: the faces stay, up to now.
    void keep(const mesh::Complex& complex) { clock_ = complex.clock(); }

    /// Arrays of build_view().
    struct Arrays {
        /// Of a block of the view's vertices.
        struct Block {
            mesh::StarWalk walk;
            std::vector<Face> faces;  ///< that the vertices of the block lead
            std::size_t first = 0;    ///< index of the first of them in the view
        };
        std::vector<std::uint64_t> keys;  ///< birth and number of each interface vertex
        std::vector<Block> blocks;
        std::vector<std::uint32_t> index;   ///< view index per complex vertex; undefined for
                                            ///< vertices that are not in the view
        std::vector<std::uint32_t> last;    ///< index of each view vertex in the view before
        std::vector<std::uint32_t> counts;  ///< number of faces that each view vertex leads
    };
    Arrays& arrays() { return arrays_; }

private:
    bool known(const mesh::Complex& complex, mesh::VertexId v, std::uint32_t i) const;

    Arrays arrays_;
    std::uint32_t clock_ = 0;            // of the complex when the view was made
    std::vector<std::uint32_t> births_;  // of the view's vertices
    std::vector<std::uint32_t> starts_;  // first face that vertex i leads
    std::vector<Face> faces_;
};

/// Fills `view` and reuses its memory. previous_positions, arrived and age become those of vertices
/// that have made no step; the run replaces them. The cost grows with the interface, not with the
/// volume.
/// `workers`, null for one thread, share the walks. With `memory`, only vertices whose star has
/// other tets or labels than in the last view are visited, and if there is none, `view` keeps its
/// connectivity; the view is the same. [step]
void build_view(const mesh::Complex& complex, SurfaceView& view, Workers* workers = nullptr,
                ViewMemory* memory = nullptr);

/// The label interface of plain arrays as a triangle mesh; points are in the order of the arrays.
/// It checks results independently of Complex. `vertex_of`, if given, receives each point's index
/// in `mesh.points`.
TriangleMesh extract_interface(const mesh::TetMesh& mesh,
                               std::vector<std::uint32_t>* vertex_of = nullptr);

/// The surface of one label above 0: all faces between its tets and other tets or the outside of
/// the box, counter-clockwise seen from outside. Where more than two labels meet, the interface is
/// not a manifold, but this surface is. `vertex_of` as above.
TriangleMesh extract_phase(const mesh::TetMesh& mesh, mesh::Label phase,
                           std::vector<std::uint32_t>* vertex_of = nullptr);

/// An edge of a view with its faces.
struct ViewEdge {
    std::array<std::uint32_t, 2> vertices;  ///< ascending
    std::array<std::uint32_t, 2> faces;  ///< its two faces with the lowest indices; mesh::none for
                                         ///< a missing face
    std::uint32_t face_count;  ///< 2, except where three labels or more meet and at the border of
                               ///< open meshes
};

/// Writes all edges, in ascending order of their vertices, to `edges` and reuses its memory. [step]
void build_edges(const SurfaceView& view, std::vector<ViewEdge>& edges);

}  // namespace dsc::surface
