#pragma once
// Reduces the number of triangles for pages and previews; never used for results.

#include <cstddef>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

/// Reduces to at most `faces` triangles if the topology allows it, by collapsing edges in the order
/// of their quadric error [Garland1997]. The number of shells, their genus and their boundaries are
/// kept. The mesh must be manifold and consistently oriented. Throws GeometryError
/// "surface.not_manifold", or as require_sound(). [step]
TriangleMesh decimate(const TriangleMesh& mesh, std::size_t faces);

}  // namespace dsc::surface
