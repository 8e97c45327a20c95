#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/statistics.hpp>

namespace {

using dsc::Vec3;
using dsc::cloud::measure_cloud;
using dsc::cloud::Statistics;

using std::numbers::pi;

/// Points spread at random over a sphere, each moved by noise in all three directions.
std::vector<Vec3> sphere(std::size_t count, double radius, double noise, std::uint64_t seed) {
    dsc::RandomStream random(dsc::RandomKey{seed, 0, 0, 0});
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 2.0 * random.uniform() - 1.0, angle = 2.0 * pi * random.uniform(),
                     r = std::sqrt(1.0 - z * z);
        const Vec3 shift(random.normal(), random.normal(), random.normal());
        points.push_back(radius * Vec3(r * std::cos(angle), r * std::sin(angle), z) +
                         noise * shift);
    }
    return points;
}

void check_equal(const Statistics& a, const Statistics& b) {
    CHECK(a.point_width == b.point_width);
    CHECK(a.label_width == b.label_width);
    CHECK(a.outlier_score == b.outlier_score);
    CHECK(a.noise == b.noise);
    CHECK(a.area == b.area);
}

}  // namespace

TEST_CASE("widths are the root of the area per point, whatever the density and the units") {
    for (const std::size_t count : {500UL, 8000UL}) {
        for (const double radius : {1e-6, 1.0, 3e5}) {
            CAPTURE(count);
            CAPTURE(radius);
            const Statistics s = measure_cloud(sphere(count, radius, 0.0, count));
            const double truth = std::sqrt(4.0 * pi * radius * radius / static_cast<double>(count));
            CHECK(s.width == doctest::Approx(truth).epsilon(0.04));
            // The share that the labels' constants were measured with.
            CHECK(s.median_label_width == doctest::Approx(0.95 * truth).epsilon(0.05));
            CHECK(s.area == doctest::Approx(4.0 * pi * radius * radius).epsilon(0.10));
            CHECK(s.spread > 1.3);
            CHECK(s.spread < 2.5);
            CHECK(s.duplicates == 0);
            // Clark and Evans: 1 for points at random.
            CHECK(s.regularity == doctest::Approx(1.0).epsilon(0.06));
        }
    }
}

TEST_CASE("little noise counts as none, much in full, without a jump between") {
    CHECK(dsc::cloud::certain_noise(0.0) == 0.0);
    CHECK(dsc::cloud::certain_noise(dsc::cloud::noise_floor) == 0.0);
    CHECK(dsc::cloud::certain_noise(0.21) == doctest::Approx(0.15));
    CHECK(dsc::cloud::certain_noise(std::nextafter(dsc::cloud::noise_certain, 0.0)) ==
          doctest::Approx(dsc::cloud::noise_certain).epsilon(1e-12));
    CHECK(dsc::cloud::certain_noise(0.7) == 0.7);
}

TEST_CASE("a triangular grid has the regularity that Clark and Evans give, 2 sqrt(2 / sqrt 3)") {
    std::vector<Vec3> points;
    for (int row = 0; row < 60; ++row) {
        for (int column = 0; column < 60; ++column)
            points.emplace_back(column + 0.5 * (row % 2), row * std::sqrt(0.75), 0.0);
    }
    // The width from the 12th neighbour is 0.956 of the true one there, and larger at the rim.
    CHECK(measure_cloud(points).regularity == doctest::Approx(2.149).epsilon(0.12));
}

TEST_CASE("the noise is that of the points, and next to nothing without") {
    const std::size_t count = 8000;
    const double h = std::sqrt(4.0 * pi / static_cast<double>(count));
    CHECK(measure_cloud(sphere(count, 1.0, 0.0, 5)).noise < 0.01 * h);
    for (const double share : {0.15, 0.3, 0.6}) {
        for (const std::uint64_t seed : {1UL, 2UL, 3UL}) {
            CAPTURE(share);
            CAPTURE(seed);
            const Statistics s = measure_cloud(sphere(count, 1.0, share * h, seed));
            CHECK(s.noise == doctest::Approx(share * h).epsilon(0.15));
            CHECK(s.noise_ratio == s.noise / s.width);
        }
    }
}

TEST_CASE("points far from all others stand out") {
    std::vector<Vec3> points = sphere(4000, 1.0, 0.0, 9);
    const std::size_t ordinary = points.size();
    points.insert(points.end(), {{0.0, 0.0, 0.0}, {1.9, 0.3, 0.0}, {0.0, -2.0, 1.0}});
    const Statistics s = measure_cloud(points);
    CHECK(*std::max_element(s.outlier_score.begin(),
                            s.outlier_score.begin() + static_cast<std::ptrdiff_t>(ordinary)) < 2.5);
    for (std::size_t i = ordinary; i < points.size(); ++i) CHECK(s.outlier_score[i] > 2.5);
}

TEST_CASE("neither threads nor the order of the points change a width") {
    const std::vector<Vec3> points = sphere(3000, 1.0, 0.02, 3);
    const Statistics alone = measure_cloud(points);
    for (const unsigned threads : {2U, 3U}) {
        dsc::Workers workers(threads);
        check_equal(alone, measure_cloud(points, &workers));
    }
    std::vector<Vec3> reversed(points.rbegin(), points.rend());
    Statistics back = measure_cloud(reversed);
    std::reverse(back.point_width.begin(), back.point_width.end());
    std::reverse(back.label_width.begin(), back.label_width.end());
    CHECK(back.point_width == alone.point_width);
    for (std::size_t i = 0; i < points.size(); ++i) {
        REQUIRE(back.label_width[i] == doctest::Approx(alone.label_width[i]).epsilon(1e-12));
    }
    CHECK(back.width == alone.width);
}

TEST_CASE("few and repeated points are measured without nonsense") {
    const std::vector<Vec3> two = {{0, 0, 0}, {3, 4, 0}};
    const Statistics pair = measure_cloud(two);
    CHECK(pair.width == doctest::Approx(5.0 * std::sqrt(pi)));
    CHECK(pair.noise == 0.0);
    const Statistics one = measure_cloud(std::vector<Vec3>{{1, 2, 3}});
    CHECK(one.width == 0.0);
    CHECK(one.outlier_score == std::vector<double>{1.0});
    const Statistics equal = measure_cloud(std::vector<Vec3>(40, Vec3(1, 1, 1)));
    CHECK(equal.width == 0.0);
    CHECK(equal.noise == 0.0);
    CHECK(equal.noise_ratio == 0.0);
    CHECK(equal.spread == 1.0);
    CHECK(equal.duplicates == 39);
    std::vector<Vec3> flat;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) flat.emplace_back(i, j, 0.0);
    }
    const Statistics plane = measure_cloud(flat);
    CHECK(plane.noise < 1e-12);
    CHECK(plane.width > 0.9);
    CHECK(plane.width < 1.3);
    CHECK_THROWS_AS(measure_cloud(std::vector<Vec3>{}), dsc::GeometryError);
}
