#pragma once
// Points of which some go: the nearest neighbours of the others among the others.

#include <cstddef>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

#include "neighbours.hpp"

namespace dsc::cloud {

/// How many neighbours per point it keeps.
inline constexpr std::size_t remaining_neighbours = 16;

class Remaining {
public:
    /// All points are there. Throws GeometryError as NearestSearch. The points must outlive it. [setup]
    Remaining(std::span<const Vec3> points, Workers* workers);

    /// Removes the points whose flag is set, and looks for new neighbours where one has gone. At least 17 points must be
    /// left. [setup]
    void remove(const std::vector<unsigned char>& gone, Workers* workers);

    std::span<const Vec3> points() const { return points_; }
    std::size_t count() const { return count_; }
    bool has(std::size_t i) const { return present_[i] != 0; }
    /// Rows of points that have gone are those of the round before they went.
    const Neighbours& neighbours() const { return neighbours_; }
    /// Median of the reach of the points that are there.
    double median_reach() const;

private:
    std::span<const Vec3> points_;
    std::vector<unsigned char> present_;
    std::size_t count_ = 0;
    std::vector<std::uint32_t> order_;  ///< along the curve of spatial_order, so that ties do not depend on the cloud's order
    Neighbours neighbours_;
};

}  // namespace dsc::cloud
