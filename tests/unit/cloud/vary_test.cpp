// Seeded variations: which points, how far, how rotated, and the way back.
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include <dsc/cloud/statistics.hpp>
#include <dsc/cloud/vary.hpp>

#include "solids.hpp"

using namespace dsc;
using namespace dsc::cloud;

namespace {

Cloud given(std::size_t count = 2000) {
    const known::Solid solid = known::sphere(count);
    Cloud cloud;
    cloud.points = solid.points;
    cloud.normals = solid.normals;
    for (Vec3& p : cloud.points) p = 3.0 * p + Vec3(5, -2, 7);
    for (std::size_t i = 0; i < count; ++i)
        cloud.colours.push_back(
            {static_cast<std::uint8_t>(i % 256), static_cast<std::uint8_t>(i / 256), 0});
    return cloud;
}

/// The index of each point of a variation that only left out points.
std::vector<std::size_t> indices(const Cloud& cloud) {
    std::vector<std::size_t> all;
    for (const Colour& c : cloud.colours) all.push_back(std::size_t{c[0]} + 256 * c[1]);
    return all;
}

}  // namespace

TEST_CASE("subsample: exactly the part, in order, another part for another seed") {
    const Cloud cloud = given();
    const Varied one = vary(cloud, {0.9, 0.0, false}, 1);
    REQUIRE(one.cloud.points.size() == 1800);
    CHECK(one.left_out == 200);
    CHECK(one.cloud.normals.size() == 1800);
    const std::vector<std::size_t> kept = indices(one.cloud);
    CHECK(std::is_sorted(kept.begin(), kept.end()));
    for (std::size_t i = 0; i < kept.size(); ++i)
        REQUIRE(one.cloud.points[i] == cloud.points[kept[i]]);
    CHECK(indices(vary(cloud, {0.9, 0.0, false}, 1).cloud) == kept);
    const std::vector<std::size_t> other = indices(vary(cloud, {0.9, 0.0, false}, 2).cloud);
    std::vector<std::size_t> both;
    std::set_intersection(kept.begin(), kept.end(), other.begin(), other.end(),
                          std::back_inserter(both));
    // Independent draws share 0.81 of the points: 1620, with a deviation below 6.
    CHECK(both.size() > 1590);
    CHECK(both.size() < 1650);
    // A smaller part is contained in a larger one.
    const std::vector<std::size_t> half = indices(vary(cloud, {0.5, 0.0, false}, 1).cloud);
    CHECK(half.size() == 1000);
    CHECK(std::includes(kept.begin(), kept.end(), half.begin(), half.end()));
}

TEST_CASE("jitter: normal displacements in spacings, the same for a point that is kept") {
    const Cloud cloud = given();
    const Varied moved = vary(cloud, {1.0, 0.5, false}, 3);
    const double width = measure_cloud(cloud.points).width;
    CHECK(moved.jitter == doctest::Approx(0.5 * width));
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        const Vec3 d = moved.cloud.points[i] - cloud.points[i];
        squares += d.squaredNorm();
        sum += d.sum();
    }
    const double n = 3.0 * static_cast<double>(cloud.points.size());
    CHECK(std::sqrt(squares / n) == doctest::Approx(0.5 * width).epsilon(0.03));
    CHECK(std::abs(sum / n) < 4.0 * 0.5 * width / std::sqrt(n));
    const Varied part = vary(cloud, {0.9, 0.5, false}, 3);
    const std::vector<std::size_t> kept = indices(part.cloud);
    for (std::size_t i = 0; i < kept.size(); ++i)
        REQUIRE(part.cloud.points[i] == moved.cloud.points[kept[i]]);
}

TEST_CASE("rotate: a rotation about the centre of the box, of points and directions") {
    const Cloud cloud = given();
    const Varied turned = vary(cloud, {1.0, 0.0, true}, 4);
    const Eigen::Matrix3d& r = turned.rotation;
    CHECK((r * r.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    CHECK(r.determinant() == doctest::Approx(1.0));
    CHECK(turned.centre == bounding_box(cloud.points).centre());
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        REQUIRE((turned.cloud.points[i] - turned.centre - r * (cloud.points[i] - turned.centre))
                    .norm() < 1e-13);
        REQUIRE((turned.cloud.normals[i] - r * cloud.normals[i]).norm() < 1e-14);
    }
    CHECK((vary(cloud, {1.0, 0.0, true}, 5).rotation - r).norm() > 0.1);
    // The transform of the varied cloud, taken back to the given one.
    const Transform after{Vec3(1, 2, 3), 0.25, std::nullopt};
    const Transform before = before_variation(after, turned);
    for (std::size_t i = 0; i < cloud.points.size(); ++i) {
        REQUIRE((before.apply(cloud.points[i]) - after.apply(turned.cloud.points[i])).norm() <
                1e-13);
        REQUIRE((before.inverse(after.apply(turned.cloud.points[i])) - cloud.points[i]).norm() <
                1e-13);
        REQUIRE((before.direction_to_input(turned.cloud.normals[i]) - cloud.normals[i]).norm() <
                1e-14);
    }
    CHECK_FALSE(before.identity());
    CHECK(before_variation({}, vary(cloud, {0.5, 0.0, false}, 1)).identity());
}

TEST_CASE("rotate: uniform over all rotations") {
    // For uniform rotations the image of an axis is uniform on the sphere: each coordinate has mean
    // 0 and mean square 1/3; the trace has mean 0 and mean square 1.
    constexpr int count = 4000;
    Vec3 mean = Vec3::Zero(), square = Vec3::Zero();
    double trace = 0.0, trace_square = 0.0;
    for (int seed = 0; seed < count; ++seed) {
        const Eigen::Matrix3d r = drawn_rotation_matrix(static_cast<std::uint64_t>(seed));
        mean += r.col(2) / count;
        square += r.col(2).cwiseAbs2() / count;
        trace += r.trace() / count;
        trace_square += r.trace() * r.trace() / count;
    }
    for (int k = 0; k < 3; ++k) {
        CHECK(std::abs(mean[k]) < 0.04);
        CHECK(std::abs(square[k] - 1.0 / 3.0) < 0.02);
    }
    CHECK(std::abs(trace) < 0.07);
    CHECK(std::abs(trace_square - 1.0) < 0.1);
}
