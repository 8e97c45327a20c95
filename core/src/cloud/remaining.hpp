#pragma once
// Points of which some are removed: the nearest neighbours of the remaining points among the
// remaining points.

#include <cstddef>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

#include "neighbours.hpp"

namespace dsc::cloud {

/// Number of neighbours that are kept per point.
inline constexpr std::size_t remaining_neighbours = 16;

class Remaining {
public:
    /// At first all points remain. Throws GeometryError as NearestSearch. The points must outlive
    /// this object. [setup]
    Remaining(std::span<const Vec3> points, Workers* workers);

    /// Removes the points whose flag is set, and searches new neighbours for points that lost one.
    /// At least 17 points must remain. [setup]
    void remove(const std::vector<unsigned char>& gone, Workers* workers);

    std::span<const Vec3> points() const { return points_; }
    std::size_t count() const { return count_; }
    bool has(std::size_t i) const { return present_[i] != 0; }
    /// Rows of removed points keep their state from before the removal.
    const Neighbours& neighbours() const { return neighbours_; }
    /// Median of the reach of the remaining points.
    double median_reach() const;

private:
    std::span<const Vec3> points_;
    std::vector<unsigned char> present_;
    std::size_t count_ = 0;
    std::vector<std::uint32_t> order_;  ///< along the curve of spatial_order, so that ties do not
                                        ///< depend on the cloud's order
    Neighbours neighbours_;
};

}  // namespace dsc::cloud
