#pragma once
// Clouds recorded from one side: depth images, single scans, terrain from the air.

#include <optional>
#include <span>
#include <vector>

#include <dsc/cloud/orientation.hpp>
#include <dsc/geometry/vec.hpp>

#include "samples.hpp"

namespace dsc::cloud {

/// A cloud in which lines along some direction meet only one layer, so that it bounds no solid by
/// itself.
struct OneSided {
    Vec3 away = Vec3::Zero();  ///< unit vector from the place of recording to the cloud
    double depth = 0.0;       ///< scaled units; a copy of the cloud moved by this distance closes a
                              ///< solid
    double area_ratio = 0.0;  ///< area seen along `away` over that of the footprint: about 1; for a
                              ///< solid 2 or more
    double layered_share = 0.0;  ///< fraction of the footprint with more than one layer
};

/// Empty for a cloud that surrounds a solid, and for fewer than 100 samples. `origin` is the origin
/// of the input's coordinates in scaled units: the possible position of a depth camera. [setup]
std::optional<OneSided> find_one_sided(const ScaledSamples& samples, const Vec3& origin);

/// The displacement of the copy that closes the cloud (Orientation::backing), in the units of the
/// points, along the unit vector `away` if given; zero for a cloud that find_one_sided() does not
/// recognise. [setup]
Vec3 backing_of(const ScaledSamples& samples, const Vec3& origin,
                const std::optional<Vec3>& away = {});

/// The points, then a copy of each that is moved by `backing` (not zero) and contracted towards the
/// centre of the box perpendicular to it, because walls parallel to `backing` would otherwise touch
/// their own copy. [setup]
std::vector<Vec3> with_copy(std::span<const Vec3> points, const Vec3& backing);
/// For results of with_copy(): keeps the entries of the first `count` points and all samples, and
/// stores `backing`. [setup]
void leave_out_copy(std::size_t count, const Vec3& backing, OrientedPoints& found);

}  // namespace dsc::cloud
