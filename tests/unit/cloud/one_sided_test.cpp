#include "cloud/one_sided.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/orientation.hpp>
#include <dsc/cloud/shapes.hpp>

using dsc::Vec3;
using namespace dsc::cloud;

namespace {

/// A hilly square of side 2, height above z = 0 of up to 0.3, moved by `shift`.
std::vector<Vec3> terrain(std::size_t n, const Vec3& shift = Vec3::Zero()) {
    dsc::RandomStream random(dsc::RandomKey{2, 0, 0, 0});
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
        points.push_back(Vec3(x, y, 0.15 * (1.0 + std::sin(4 * x) * std::cos(3 * y))) + shift);
    }
    return points;
}

std::optional<OneSided> found_in(const std::vector<Vec3>& points) {
    const ScaledSamples samples = scaled_samples(points, nullptr);
    return find_one_sided(samples, -samples.centre / samples.diagonal);
}

/// The side of a ball that a camera at (0, 0, -5) sees.
std::vector<Vec3> seen_half(std::size_t n) {
    std::vector<Vec3> points;
    for (const Vec3& p : sample_shape("sphere", 2 * n, 7).points)
        if (p.z() < -0.2) points.push_back(p + Vec3(0, 0, 5));
    return points;
}

}  // namespace

TEST_CASE("one side: terrain is seen from above, wherever it lies") {
    for (const Vec3& shift : {Vec3(0, 0, 0), Vec3(512345, 5403210, 0), Vec3(0.5, 0.2, 0.1)}) {
        const auto found = found_in(terrain(3000, shift));
        REQUIRE(found);
        CHECK(found->away.z() < -0.8);
        CHECK(found->area_ratio < 1.3);
        CHECK(found->layered_share < 0.02);
        CHECK(found->depth > 0.0);
    }
}

TEST_CASE("one side: a depth camera stands at the origin") {
    const auto found = found_in(seen_half(4000));
    REQUIRE(found);
    CHECK(found->away.z() > 0.8);
}

TEST_CASE("one side: clouds that surround a solid are not of this kind, in any pose") {
    dsc::RandomStream random(dsc::RandomKey{4, 0, 0, 0});
    for (const char* name : {"sphere", "torus", "box_tunnel", "teapot"}) {
        for (const std::size_t n : {400U, 3000U, 20000U}) {
            if (n == 400 && std::string(name) == "teapot")
                continue;  // open at its lid, with a handle one point wide
            const Vec3 axis = Vec3(random.normal(), random.normal(), random.normal()).normalized();
            const Eigen::Matrix3d turn =
                Eigen::AngleAxisd(random.uniform(0, 6), axis).toRotationMatrix();
            std::vector<Vec3> points = sample_shape(name, n, n).points;
            for (Vec3& p : points) p = turn * p;
            CAPTURE(std::string(name));
            CAPTURE(n);
            CHECK_FALSE(found_in(points));
            CHECK_FALSE(found_in(sample_shape(name, n, n, 0.005).points));
        }
    }
}

TEST_CASE("one side: a tube with open ends has two sides, also where it is seen along its wall") {
    dsc::RandomStream random(dsc::RandomKey{3, 0, 0, 0});
    std::vector<Vec3> points;
    for (int i = 0; i < 4000; ++i) {
        const double angle = random.uniform(0, 6.283185307179586);
        points.emplace_back(std::cos(angle), std::sin(angle), random.uniform(0, 2));
    }
    CHECK_FALSE(found_in(points));
}

TEST_CASE("one side: too few points decide nothing") { CHECK_FALSE(found_in(terrain(60))); }

TEST_CASE("one side: normals face the recorder, and a copy closes the solid") {
    const std::vector<Vec3> points = terrain(3000);
    const OrientedPoints found = orient_points(points);
    REQUIRE(found.orientation.one_sided());
    CHECK(found.orientation.backing.z() < 0.0);
    CHECK(found.orientation.samples.size() > 5900);  // but those that lie inside or outside
    REQUIRE(found.normals.size() == 3000);
    REQUIRE(found.areas.size() == 3000);
    REQUIRE(found.confidence.size() == 3000);
    std::size_t up = 0;
    for (const Vec3& n : found.normals) up += n.z() > 0.5 ? 1 : 0;
    CHECK(up > 2970);
    CHECK(found.orientation.residual < 0.12);

    OrientOptions never;
    never.backing = Vec3(Vec3::Zero());
    CHECK_FALSE(orient_points(points, never).orientation.one_sided());
    OrientOptions given;
    given.backing = Vec3(0, 0, -0.7);
    CHECK(orient_points(points, given).orientation.backing == Vec3(0, 0, -0.7));
}
