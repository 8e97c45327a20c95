#pragma once
// Statistics of a cloud from which all lengths of a reconstruction are derived: the distances of
// its points and its noise.

#include <cstddef>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Lengths in the units of the points.
struct Statistics {
    std::vector<double> point_width;  ///< per point: the spacing, root of the area per point, from
                                      ///< the 12th neighbour
    std::vector<double> label_width;  ///< per point: the same from the 8th neighbour, averaged;
                                      ///< 0.92 of the true value
    std::vector<double> outlier_score;  ///< per point: distance to the 8th neighbour over its
                                        ///< neighbours' median
    double width = 0.0;                 ///< median of point_width
    double median_label_width = 0.0;
    double noise = 0.0;        ///< standard deviation of the points across the surface
    double noise_ratio = 0.0;  ///< noise / width; 0 if the width is 0
    double spread = 1.0;  ///< 0.9-quantile of point_width over its 0.1-quantile; below 3 the cloud
                          ///< is even
    double regularity = 1.0;  ///< mean distance to the nearest point over half the width there: 1
                              ///< at random, 2.15 for a triangular grid [ClarkEvans1954]
    double area = 0.0;        ///< sum of min(point_width, 2 width)^2: area of the surface
    std::size_t duplicates = 0;  ///< number of points that repeat an earlier point

    /// Whether one width holds everywhere: `spread` is below 3. [parallel]
    bool even() const { return spread < 3.0; }
};

/// Noise in spacings; below it, noise cannot be distinguished from the curvature of an
/// under-sampled surface.
inline constexpr double noise_floor = 0.12;
/// Noise in spacings; from it on, the whole noise counts.
inline constexpr double noise_certain = 0.3;

/// The part of a measured noise ratio of an even cloud that is certainly noise: 0 up to
/// `noise_floor`, all from `noise_certain` on, interpolated linearly between them. [parallel]
double certain_noise(double noise_ratio);

/// The square root of the area per point if `neighbours` other points lie within `distance`:
/// sqrt(pi r^2 / k). [parallel]
double width_of(double distance, double neighbours);

/// Number of vertices of a surface: half, all or twice the budget that follows from the number of
/// points.
enum class Detail { low, medium, high };

/// The budget of vertices for a number of points: 2 per point up to 3,000 points, 1 per point at
/// 20,000, interpolated linearly between them; above that it grows with the square root of the
/// number of points. Low detail halves it, high detail doubles it. [parallel]
double vertex_budget(std::size_t points, Detail detail = Detail::medium);

/// Measures the points. The result does not depend on the number of threads. The noise is measured
/// at no more than 2,000 points, evenly spread over their order; all other values do not depend on
/// the order. The noise of fewer than 12 points cannot be measured and is 0. `workers` may be null:
/// one thread. Throws GeometryError as NearestSearch. [setup]
Statistics measure_cloud(std::span<const Vec3> points, Workers* workers = nullptr);
/// The same with an existing search. [setup]
Statistics measure_cloud(const NearestSearch& search, Workers* workers = nullptr);

}  // namespace dsc::cloud
