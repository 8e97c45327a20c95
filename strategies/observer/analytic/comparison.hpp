#pragma once
// The distance of a triangle mesh from a sphere or from another mesh, measured over its faces and
// not only at its vertices.

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::strategies {

/// In the units of the mesh. All are 0 for a mesh without faces.
struct SphereComparison {
    double radius = 0.0;  ///< mean distance of the vertices from the centre, weighted by the area
                          ///< around each vertex
    double mean_distance = 0.0;     ///< of the surface from the sphere, over its area
    double largest_distance = 0.0;  ///< exact: of vertices outside the sphere, of face interiors
                                    ///< inside it
};
SphereComparison compare_with_sphere(const surface::TriangleMesh& mesh, const Vec3& centre,
                                     double radius);

/// Mean distance between two surfaces: the larger of the two means over the area of one to the
/// other. Both must have faces with area.
double mean_distance(const surface::TriangleMesh& a, const surface::TriangleMesh& b);

}  // namespace dsc::strategies
