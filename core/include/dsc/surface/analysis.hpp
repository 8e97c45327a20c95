#pragma once
// Properties of a triangle mesh as a surface: closed, manifold, oriented, number of pieces, genus.

#include <cstddef>
#include <vector>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

/// One connected piece: faces joined through edges. Two fans of faces that touch only at a vertex
/// are not joined; the vertex counts once per fan.
struct ShellReport {
    std::size_t vertices = 0;
    std::size_t edges = 0;
    std::size_t faces = 0;
    long euler = 0;                  ///< vertices - edges + faces
    std::size_t boundary_loops = 0;  ///< 0 if the shell is not a manifold
    bool closed = false;             ///< every edge is used equally often in both directions
    bool manifold = false;  ///< every edge has one or two faces, two in opposite directions
    long genus = 0;         ///< (2 - euler - boundary_loops) / 2 for manifold shells, else 0
    double volume = 0.0;    ///< signed, for closed shells, else 0
    double area = 0.0;
};

/// Lengths are in the units of the points.
struct SurfaceReport {
    std::size_t vertices = 0;          ///< points that faces use
    std::size_t unused_points = 0;     ///< points that no face uses
    std::size_t duplicate_points = 0;  ///< used points with the coordinates of an earlier used
                                       ///< point
    std::size_t faces = 0;  ///< faces analysed: all except invalid ones and those that use a point
                            ///< twice
    std::size_t edges = 0;  ///< undirected
    std::size_t boundary_edges = 0;        ///< edges with one face
    std::size_t nonmanifold_edges = 0;     ///< edges with more than two faces
    std::size_t misoriented_edges = 0;     ///< directed edges used more than once
    std::size_t nonmanifold_vertices = 0;  ///< vertices whose faces are not one fan, joined through
                                           ///< edges
    std::size_t duplicate_faces = 0;       ///< faces with the same three points as an earlier face
    std::size_t degenerate_faces = 0;  ///< faces that use a point twice or have exactly collinear
                                       ///< points
    std::size_t invalid_faces = 0;     ///< faces with an index out of range or a point that is not
                                       ///< finite
    std::size_t shells = 0;
    std::size_t components = 0;  ///< closed shells of positive volume
    std::size_t cavities = 0;    ///< closed shells of negative volume
    long genus = 0;              ///< sum over the shells
    long euler = 0;              ///< vertices - edges + faces of the whole mesh
    double volume = 0.0;         ///< sum over the closed shells
    double area = 0.0;
    Box3 box;  ///< of the used points
    double edge_min = 0.0;
    double edge_mean = 0.0;
    double edge_max = 0.0;
    std::vector<ShellReport> shell_reports;  ///< in the order of their first faces

    /// Closed, manifold and consistently oriented, with at least one face and without defective
    /// faces. Self-intersections are counted by intersections.hpp.
    bool closed_manifold() const {
        return faces > 0 && boundary_edges == 0 && nonmanifold_edges == 0 &&
               misoriented_edges == 0 && nonmanifold_vertices == 0 && duplicate_faces == 0 &&
               degenerate_faces == 0 && invalid_faces == 0;
    }
};

/// Analyses any input, also a badly damaged one. Points are distinguished by index: call weld()
/// first if the file repeats points. [parallel]
SurfaceReport analyse(const TriangleMesh& mesh);

}  // namespace dsc::surface
