#pragma once
// Clouds that were recorded from one side: depth images, single scans, terrain from the air.

#include <optional>
#include <span>
#include <vector>

#include <dsc/cloud/orientation.hpp>
#include <dsc/geometry/vec.hpp>

#include "samples.hpp"

namespace dsc::cloud {

/// A cloud that lines along some direction meet in one layer only, so that it bounds no solid by itself.
struct OneSided {
    Vec3 away = Vec3::Zero();    ///< unit vector from where the cloud was recorded to the cloud
    double depth = 0.0;          ///< scaled units; a copy of the cloud that is moved so far away closes a solid
    double area_ratio = 0.0;     ///< area of the cloud as seen along `away` over that of its footprint: about 1; of a solid 2 or more
    double layered_share = 0.0;  ///< part of the footprint where there is more than one layer
};

/// Empty for a cloud that surrounds a solid, and for fewer than 100 samples. `origin` is the origin of the input's
/// coordinates in scaled units: where a depth camera stands. [setup]
std::optional<OneSided> find_one_sided(const ScaledSamples& samples, const Vec3& origin);

/// The way of the copy that closes the cloud (Orientation::backing), in the units of the points, along the unit vector `away` where one is
/// given; zero for a cloud that find_one_sided() does not recognise. [setup]
Vec3 backing_of(const ScaledSamples& samples, const Vec3& origin, const std::optional<Vec3>& away = {});

/// The points, then a copy of each that is moved by `backing`, above 0, and drawn towards the box's centre across it: walls that lie
/// along it would meet their own copy. [setup]
std::vector<Vec3> with_copy(std::span<const Vec3> points, const Vec3& backing);
/// Of what was found for with_copy(): keeps the entries of the first `count` points and all samples, and notes `backing`. [setup]
void leave_out_copy(std::size_t count, const Vec3& backing, OrientedPoints& found);

}  // namespace dsc::cloud
