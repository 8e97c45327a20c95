#pragma once
// The mesh that the remeshing programs get, and the figures of a mesh.

#include <cstddef>

#include <dsc/mesh/tet_mesh.hpp>

#include "pipeline.hpp"

namespace dsc::bench {

/// A ball of label 1 in a box of label 0: a uniform `grid` whose interface lies on the sphere. All
/// vertices off the interface and the box are displaced at random, so that there is something to
/// improve; every tet stays positive. The same for every call.
mesh::TetMesh rough_ball(const Plugins& plugins, unsigned cells);

struct MeshFigures {
    std::size_t vertices = 0;
    std::size_t tets = 0;
    double mean_edge = 0.0;       ///< over all edges
    double least_quality = 0.0;   ///< volume-length measure (method.md, section 1.1)
    double low_quality = 0.0;     ///< its 5th percentile
    double least_dihedral = 0.0;  ///< degrees
    double volume = 0.0;
    double ball_volume = 0.0;  ///< of the tets with a label above 0
};
MeshFigures measure_mesh(const mesh::TetMesh& mesh);

}  // namespace dsc::bench
