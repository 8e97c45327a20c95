#pragma once
// The nearest neighbours of all points of a cloud, and figures computed only from them.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// Number of neighbours that define how far apart points are.
inline constexpr std::size_t reach_neighbours = 8;

/// A table of neighbours.
struct Neighbours {
    std::size_t each = 0;  ///< neighbours per point: the wanted number, or all other points
    std::vector<std::uint32_t> index;  ///< `each` per point, by distance then index, without the
                                       ///< point itself
    std::vector<double> reach;         ///< per point: distance to its 8th neighbour, or its last

    std::span<const std::uint32_t> of(std::size_t i) const {
        return {index.data() + i * each, each};
    }
    /// Number of neighbours that `reach` uses.
    std::size_t reached() const { return each < reach_neighbours ? each : reach_neighbours; }
};

/// The points along a Z-shaped curve through space, ties by index. Neighbours along the curve are
/// mostly neighbours in space, so a search in this order uses the caches well. [setup]
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points);

/// Finds `wanted` neighbours, at least 8, of every point. Throws GeometryError as NearestSearch.
/// [setup]
Neighbours find_neighbours(std::span<const Vec3> points, std::size_t wanted, Workers* workers);

/// Per point: the median reach of its 8 nearest neighbours. [setup]
std::vector<double> median_reaches(const Neighbours& neighbours, Workers* workers);

/// Per point: the square root of the area that it represents, as Statistics::label_width. [setup]
std::vector<double> label_widths(const Neighbours& neighbours, Workers* workers);

}  // namespace dsc::cloud
