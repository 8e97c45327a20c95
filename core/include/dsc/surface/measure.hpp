#pragma once
// Sizes, normals and cleaning of triangle meshes.

#include <span>
#include <vector>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

/// Throws GeometryError "surface.index" (naming the first face) if a face refers to a point that
/// does not exist, "surface.not_finite" if a point is NaN or infinite. [setup]
void require_sound(const TriangleMesh& mesh);

/// Sum of the faces' areas, in squared units of the points. The mesh must be sound. [parallel]
double area(const TriangleMesh& mesh);

/// Mean length of the faces' edges: an edge counts once per face, so on a closed surface this is
/// the mean over its edges. 0 without
/// faces. Every index must exist. [parallel]
double mean_edge(std::span<const Vec3> points, std::span<const std::array<std::uint32_t, 3>> faces);

/// Signed enclosed volume by the divergence theorem, positive if faces are oriented outwards; valid
/// for closed meshes only. The mesh must be sound. [parallel]
double volume(const TriangleMesh& mesh);

/// Box of the points that faces use; empty without faces. The mesh must be sound. [parallel]
Box3 used_box(const TriangleMesh& mesh);

/// Unit normal of every face; zero for a degenerate face. The mesh must be sound. [parallel]
std::vector<Vec3> face_normals(const TriangleMesh& mesh);

/// Unit normal of every point: the mean of its faces' normals, weighted by the angle of each face
/// at the point [Thurmer1998]; zero if no face uses the point. The mesh must be sound. [parallel]
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);

/// For every point, the first point with equal coordinates (-0 equals 0): itself or an earlier one.
/// [parallel]
std::vector<std::uint32_t> first_equal(std::span<const Vec3> points);

/// Joins points with equal coordinates (-0 equals 0), drops faces that use a point twice and points
/// that no face uses. The remaining points and faces keep their order. The mesh must be sound.
/// [parallel]
TriangleMesh weld(const TriangleMesh& mesh);

}  // namespace dsc::surface
