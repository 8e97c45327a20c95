// Leaves out, moves and rotates the points of a cloud by random streams.
#include "dsc/cloud/vary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <dsc/base/random.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/cloud/statistics.hpp>

namespace dsc::cloud {
namespace {

/// The indices of the points that are kept, ascending: those with the smallest random numbers.
std::vector<std::size_t> kept_points(std::size_t count, double part, std::uint64_t seed) {
    const std::uint64_t stream = stream_id("input.cloud.vary.subsample");
    std::vector<double> draws(count);
    for (std::size_t i = 0; i < count; ++i) draws[i] = RandomStream({seed, stream, 0, i}).uniform();
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto kept = static_cast<std::size_t>(std::llround(part * static_cast<double>(count)));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(draws[a], a) < std::pair(draws[b], b);
    });
    order.resize(std::min(kept, count));
    std::sort(order.begin(), order.end());
    return order;
}

void move_points(std::vector<Vec3>& points, const std::vector<std::size_t>& indices,
                 double deviation, std::uint64_t seed) {
    const std::uint64_t stream = stream_id("input.cloud.vary.jitter");
    for (std::size_t i = 0; i < points.size(); ++i) {
        RandomStream random({seed, stream, 0, indices[i]});
        for (int k = 0; k < 3; ++k) points[i][k] += deviation * random.normal();
    }
}

}  // namespace

std::array<double, 4> drawn_rotation(std::uint64_t seed) {
    RandomStream random({seed, stream_id("input.cloud.vary.rotate"), 0, 0});
    const double part = random.uniform();
    const double first = 2.0 * std::numbers::pi * random.uniform(),
                 second = 2.0 * std::numbers::pi * random.uniform();
    const double a = std::sqrt(1.0 - part), b = std::sqrt(part);
    return {b * std::cos(second), a * std::sin(first), a * std::cos(first), b * std::sin(second)};
}

Eigen::Matrix3d drawn_rotation_matrix(std::uint64_t seed) {
    const auto [w, x, y, z] = drawn_rotation(seed);
    return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

void rotate(Cloud& cloud, const Eigen::Matrix3d& rotation, const Vec3& centre) {
    const auto turn = [&](Vec3& p) { p = Vec3(rotation * (p - centre)) + centre; };
    const auto turn_direction = [&](Vec3& v) { v = Vec3(rotation * v); };
    std::for_each(cloud.points.begin(), cloud.points.end(), turn);
    std::for_each(cloud.normals.begin(), cloud.normals.end(), turn_direction);
    std::for_each(cloud.areas.begin(), cloud.areas.end(), turn_direction);
    for (SurfaceSample& sample : cloud.orientation.samples) {
        turn(sample.position);
        turn_direction(sample.area);
    }
    turn_direction(cloud.orientation.backing);
    if (cloud.sensor) turn(cloud.sensor->position);
}

Varied vary(Cloud given, const Variation& variation, std::uint64_t seed, Workers* workers) {
    Varied varied;
    const std::size_t count = given.points.size();
    if (variation.jitter > 0.0)
        varied.jitter = variation.jitter * measure_cloud(given.points, workers).width;
    const std::vector<std::size_t> kept = kept_points(count, variation.subsample, seed);
    varied.left_out = count - kept.size();
    varied.cloud = varied.left_out == 0 ? std::move(given) : pick(given, kept);
    Cloud& cloud = varied.cloud;
    if (varied.jitter > 0.0) move_points(cloud.points, kept, varied.jitter, seed);
    if (variation.rotate && !cloud.points.empty()) {
        varied.rotation = drawn_rotation_matrix(seed);
        varied.centre = bounding_box(cloud.points).centre();
        rotate(cloud, varied.rotation, varied.centre);
    }
    return varied;
}

Transform before_variation(const Transform& after, const Varied& varied) {
    if (varied.rotation == Eigen::Matrix3d::Identity()) return after;
    // after: (R (x - c) + c - m) s = R (x - (c + R^T (m - c))) s
    Transform transform = after;
    transform.rotation = varied.rotation;
    transform.centre =
        varied.centre + Vec3(varied.rotation.transpose() * (after.centre - varied.centre));
    return transform;
}

}  // namespace dsc::cloud
