#pragma once
// The nearest neighbours of all points of a cloud, and what follows from them alone.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::cloud {

/// How many neighbours say how far apart points are.
inline constexpr std::size_t reach_neighbours = 8;

/// A table of neighbours.
struct Neighbours {
    std::size_t each = 0;              ///< neighbours per point: as many as wanted, or all others
    std::vector<std::uint32_t> index;  ///< `each` per point, by distance then index, without the point itself
    std::vector<double> reach;         ///< per point: distance to its 8th neighbour, or its last

    std::span<const std::uint32_t> of(std::size_t i) const { return {index.data() + i * each, each}; }
    /// Neighbours that `reach` counts.
    std::size_t reached() const { return each < reach_neighbours ? each : reach_neighbours; }
};

/// The points along a Z-shaped curve through space, ties by index: neighbours in it are mostly neighbours in space, so that a
/// search that follows it finds what it needs in the caches. [setup]
std::vector<std::uint32_t> spatial_order(std::span<const Vec3> points);

/// Finds `wanted` neighbours, at least 8, of every point. Throws GeometryError as NearestSearch. [setup]
Neighbours find_neighbours(std::span<const Vec3> points, std::size_t wanted, Workers* workers);

/// Per point: the median reach of its 8 nearest neighbours. [setup]
std::vector<double> median_reaches(const Neighbours& neighbours, Workers* workers);

/// Per point: the root of the area that it stands for, as Statistics::label_width. [setup]
std::vector<double> label_widths(const Neighbours& neighbours, Workers* workers);

/// The upper median; 0 without values.
double median_of(std::vector<double> values);

}  // namespace dsc::cloud
