#pragma once
// Exact search for faces of a mesh that intersect each other.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc {
class Workers;
}

namespace dsc::surface {

struct IntersectionReport {
    std::size_t count = 0;                            ///< pairs of faces
    std::vector<std::array<std::uint32_t, 2>> pairs;  ///< the first pairs, each ascending, all in
                                                      ///< ascending order
    std::size_t degenerate_faces = 0;  ///< faces of zero area; the search ignores them
};

/// Pairs of faces that meet in more than the vertex or edge that they share by index. Touching
/// counts, coplanar overlap counts, and so do two faces with the same three points. Exact for all
/// finite doubles. `keep` limits `pairs`. Throws as require_sound(). [step]
IntersectionReport self_intersections(const TriangleMesh& mesh, std::size_t keep = 16,
                                      Workers* workers = nullptr);

/// Whether two closed triangles have a common point; exact. Neither triangle may be degenerate.
/// [parallel]
bool triangles_intersect(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q);

/// Whether a triangle has exactly zero area. [parallel]
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace dsc::surface
