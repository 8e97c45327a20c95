#pragma once
// Surfaces with a known truth, for the tests of strategies.

#include <functional>

#include <dsc/surface/surface_view.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::sdk {

/// Icosahedron whose faces are split `level` times into four, with its vertices on a sphere round
/// the origin.
surface::TriangleMesh icosphere(unsigned level, double radius);

/// Square [-half, half]^2 in the plane z = 0, normals up, n x n cells of two triangles; its border
/// is open.
surface::TriangleMesh square(unsigned n, double half);

/// The view of any oriented triangle mesh between the labels 0 (outside) and 1; every vertex is
/// movable and has made no step, and births count from 0.
/// `vertex_ids` and `face_tets` do not belong to a complex.
surface::SurfaceView view_of(const surface::TriangleMesh& mesh);

/// The mesh with every point moved by `move`.
surface::TriangleMesh moved(surface::TriangleMesh mesh,
                            const std::function<Vec3(const Vec3&)>& move);

}  // namespace dsc::sdk
