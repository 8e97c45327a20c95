#pragma once
// How far a triangle mesh is from a sphere or from another mesh, measured over its faces and not only at its vertices.

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::strategies {

/// In the units of the mesh. All are 0 for a mesh without faces.
struct SphereComparison {
    double radius =
        0.0;  ///< mean distance of the vertices from the centre, each weighted by the area round it
    double mean_distance = 0.0;     ///< of the surface from the sphere, over its area
    double largest_distance = 0.0;  ///< exact: of vertices outside, of face interiors inside
};
SphereComparison compare_with_sphere(const surface::TriangleMesh& mesh, const Vec3& centre, double radius);

/// Mean distance between two surfaces: over the area of each to the other, the larger of the two means. Both must
/// have faces with area.
double mean_distance(const surface::TriangleMesh& a, const surface::TriangleMesh& b);

}  // namespace dsc::strategies
