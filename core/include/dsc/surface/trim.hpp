#pragma once
// The part of a closed surface that its data supports, as a surface with a border.

#include <cstdint>
#include <dsc/surface/triangle_mesh.hpp>
#include <span>
#include <vector>

namespace dsc::surface {

struct TrimOptions {
    double distance = 2.0;  ///< a face with a vertex that has a larger gap goes
    double support = 0.0;   ///< so does one with a vertex of less support, where there is any
};

/// What trim() removed.
struct TrimReport {
    std::size_t faces = 0;  ///< removed
    double area_share = 0.0;  ///< of the surface
    std::size_t islands = 0;  ///< pieces that were left over and too small to stay
};

/// The faces that stay. `gaps` has a value per point of the mesh: distance to the data in spacings. `support`, 0 to 1, has one too, or is
/// empty. From the faces that go by the options, the removal spreads over neighbours with a vertex of a gap above half the
/// bound; then pieces of less than 2 % of the area, teeth of the border (faces with two edges on it) and fans of faces that
/// only touch others in a vertex go. So a manifold stays manifold. `points_of`, if not null, gets the point in `mesh` of each
/// point of the result. Colours stay. Throws GeometryError "trim.values" for a wrong number of values. [parallel]
TriangleMesh trim(const TriangleMesh& mesh, std::span<const double> gaps, std::span<const double> support, const TrimOptions& options = {},
                  std::vector<std::uint32_t>* points_of = nullptr, TrimReport* report = nullptr);

}  // namespace dsc::surface
