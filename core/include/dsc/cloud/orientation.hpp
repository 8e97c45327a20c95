#pragma once
// Inside and outside of a cloud from its points alone: area vectors whose winding number is 1/2 at the points.

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
    bool all_points = false;  ///< the coarse stage uses every sample instead of 8,000 means: slower, better at thin parts
    std::size_t coarse_iterations = 40;
    std::size_t fine_iterations = 12;
    std::optional<Vec3> backing{};  ///< Orientation::backing: zero for none; empty: it is found out whether the cloud needs one
};

/// A cloud with normals that point out of the solid. One entry per given point, in its order.
struct OrientedPoints {
    std::vector<Vec3> normals;       ///< unit vectors
    std::vector<Vec3> areas;         ///< area vectors; a sample's is shared by its points; zero for points that were dropped
    std::vector<double> confidence;  ///< (1 - 2 |w - 1/2|) |n . p|, at least 0: w is the winding number at the sample, n the
                                     ///< field's normal, p the normal of the plane through its neighbours; 0 for dropped points
    Orientation orientation;         ///< samples in lexicographic order of the points or, of a large cloud, in that of its cells
    std::size_t representatives = 0;  ///< samples of the coarse stage; 0 where the file's normals were used
    std::size_t dropped = 0;          ///< samples that were left out because they lie inside or outside
    double coarse_residual = 0.0;     ///< root mean square of 1/2 - w at the end of the coarse stage
};

/// Clouds with more different points than this are oriented by the means of about 20,000 cells.
inline constexpr std::size_t most_samples = 30000;

/// Estimates normals and area vectors by winding number normal consistency [Lin2024], in two stages, over clusters of sources
/// (WindingField). A cloud that was recorded from one side bounds no solid: a copy of it farther away from the recorder closes
/// one, and the normals start, in place of the first stage, towards the recorder. Lengths are taken from the spacing (Statistics::label_width). The order of the points, repeated points
/// and the number of threads change nothing. `cancel` and `workers` may be null. `name` opens messages. Throws
/// GeometryError as require_volume (normalize.hpp), CancelledError. [setup]
OrientedPoints orient_points(std::span<const Vec3> points, const OrientOptions& options = {}, Workers* workers = nullptr,
                             const CancelToken* cancel = nullptr, std::string_view name = {});

/// The same from normals that are known, one per point, of any length above 0: the area vectors lie along them, as long as the
/// square of the width (width_of the 12th neighbour). Throws as orient_points, and GeometryError "cloud.normals" for a
/// normal that is not finite or zero. [setup]
OrientedPoints orient_by_normals(std::span<const Vec3> points, std::span<const Vec3> normals, Workers* workers = nullptr,
                                 const CancelToken* cancel = nullptr, std::string_view name = {});

}  // namespace dsc::cloud
