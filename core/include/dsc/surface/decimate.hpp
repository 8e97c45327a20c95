#pragma once
// Fewer triangles for pages and previews; never for results.

#include <cstddef>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

/// At most `faces` triangles where the topology allows it, by collapsing edges in the order of their quadric
/// error [Garland1997]. The number of shells, their genus and their boundaries stay. The mesh must be
/// manifold and consistently oriented: throws GeometryError "surface.not_manifold", or as require_sound().
/// [step]
TriangleMesh decimate(const TriangleMesh& mesh, std::size_t faces);

}  // namespace dsc::surface
