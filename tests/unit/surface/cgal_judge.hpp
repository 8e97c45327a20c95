#pragma once
// CGAL as an independent judge. The one place of the project that includes it, and only in tests.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface::test {

using FacePairs = std::vector<std::array<std::uint32_t, 2>>;

/// Pairs of faces whose intersection, constructed exactly, is more than what they share by index.
/// Any soup; degenerate faces are left out. Quadratic.
FacePairs cgal_soup_intersections(const TriangleMesh& mesh);

/// The same from Polygon_mesh_processing::self_intersections. Manifold meshes only.
FacePairs cgal_mesh_intersections(const TriangleMesh& mesh);

/// Squared distance from p to the nearest triangle in exact arithmetic, rounded at the end.
double cgal_squared_distance(const Vec3& p, const TriangleMesh& mesh);

}  // namespace dsc::surface::test
