#pragma once
// Finds inside and outside of a cloud from its points alone: area vectors whose winding number is
// 1/2 at the points.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/cloud.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

struct OrientOptions {
    bool all_points = false;  ///< the coarse stage uses every sample instead of 8,000 means:
                              ///< slower, better at thin parts
    std::size_t coarse_iterations = 40;
    std::size_t fine_iterations = 12;
    std::optional<Vec3> backing{};  ///< Orientation::backing: zero for none; empty: the function
                                    ///< finds out whether it is needed
};

/// A cloud with normals that point out of the solid. One entry per given point, in the order of the
/// points.
struct OrientedPoints {
    std::vector<Vec3> normals;  ///< unit vectors
    std::vector<Vec3> areas;    ///< area vectors; the points of a sample share its vector; zero for
                                ///< dropped points
    /// (1 - 2 |w - 1/2|) |n . p|, at least 0: w is the winding number at the sample, n the field's
    /// normal, p the normal of the plane through its neighbours; 0 for dropped points.
    std::vector<double> confidence;
    Orientation orientation;  ///< samples in lexicographic order of the points; for a large cloud
                              ///< in the order of its cells
    std::size_t representatives = 0;  ///< samples of the coarse stage; 0 if the file's normals were
                                      ///< used
    std::size_t dropped = 0;  ///< samples that were left out because they lie inside or outside
    double coarse_residual = 0.0;  ///< root mean square of 1/2 - w at the end of the coarse stage
};

/// Clouds with more different points than this are represented by the means of about 20,000 cells.
inline constexpr std::size_t most_samples = 30000;

/// Estimates normals and area vectors by winding number normal consistency [Lin2024], in two
/// stages, over clusters of sources (WindingField). A cloud recorded from one side bounds no solid.
/// A copy of it, farther away from the recorder, closes a solid; the normals then start towards the
/// recorder, instead of the first stage. Lengths depend on the spacing (Statistics::label_width).
/// The result does not depend on the order of the points, on repeated points or on the number of
/// threads. `cancel` and `workers` may be null. Messages begin with `name`. Throws GeometryError as
/// require_volume (normalize.hpp), CancelledError. [setup]
OrientedPoints orient_points(std::span<const Vec3> points, const OrientOptions& options = {},
                             Workers* workers = nullptr, const CancelToken* cancel = nullptr,
                             std::string_view name = {});

/// The same from known normals, one per point, of any length above 0: an area vector is parallel to
/// the normal, its length is the square of the width (width_of the 12th neighbour). Throws as
/// orient_points, and GeometryError "cloud.normals" for a normal that is not finite or zero.
/// [setup]
OrientedPoints orient_by_normals(std::span<const Vec3> points, std::span<const Vec3> normals,
                                 Workers* workers = nullptr, const CancelToken* cancel = nullptr,
                                 std::string_view name = {});

}  // namespace dsc::cloud
