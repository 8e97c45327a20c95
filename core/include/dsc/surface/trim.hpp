#pragma once
// The part of a closed surface that data supports, as a surface with a border.

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

struct TrimOptions {
    double distance = 2.0;  ///< faces with a vertex that has a larger gap are removed
    double support = 0.0;  ///< faces with a vertex of less support are removed, if there is support
};

/// What trim() removed.
struct TrimReport {
    std::size_t faces = 0;    ///< removed
    double area_share = 0.0;  ///< of the surface
    std::size_t islands = 0;  ///< pieces that were left and too small to keep
};

/// The faces that stay. `gaps` contains the distance to the data, in spacings, per point of the
/// mesh. `support`, 0 to 1, has one value per point or is empty. The removal starts with the faces
/// that the options exclude, and spreads to neighbours that have a vertex with a gap above half the
/// bound. Then it removes pieces of less than 2 % of the area, teeth of the border (faces with two
/// edges on it) and fans of faces that touch other faces only in a vertex. So a manifold stays a
/// manifold. `points_of`, if not null, receives for each point of the result its index in `mesh`.
/// Colours are kept. Throws GeometryError "trim.values" for a wrong number of values. [parallel]
TriangleMesh trim(const TriangleMesh& mesh, std::span<const double> gaps,
                  std::span<const double> support, const TrimOptions& options = {},
                  std::vector<std::uint32_t>* points_of = nullptr, TrimReport* report = nullptr);

}  // namespace dsc::surface
