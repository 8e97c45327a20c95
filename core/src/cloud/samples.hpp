#pragma once
// A cloud prepared for its orientation: without repeated points, scaled by its size, and reduced to
// cells if it is large.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>

#include "neighbours.hpp"

namespace dsc::cloud {

/// The samples of an orientation, in scaled units: the box is centred at the origin and has a
/// diagonal of 1.
struct ScaledSamples {
    Vec3 centre = Vec3::Zero();
    double diagonal = 1.0;
    std::vector<std::uint32_t> first_point;  ///< the first given point of each sample; unless
                                             ///< clustered, all are equal
    std::vector<std::uint32_t> of_point;     ///< sample of each given point
    std::vector<std::uint32_t> counts;       ///< number of given points per sample
    bool clustered = false;                  ///< samples are means of cells, not points

    std::vector<Vec3> positions;
    Neighbours neighbours;       ///< 16 each
    std::vector<double> widths;  ///< label_width
    std::vector<Vec3> normals;   ///< of the planes through the neighbours, without a sign
    double width = 0.0;          ///< median of the widths
    double noise = 0.0;          ///< sigma_q

    bool noisy() const { return noise > 0.25 * width; }
    std::size_t size() const { return positions.size(); }
};

/// Prepares points that bound a volume. [setup]
ScaledSamples scaled_samples(std::span<const Vec3> points, Workers* workers);

}  // namespace dsc::cloud
