#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>

using namespace dsc;
using namespace dsc::geometry;

TEST_CASE("volume-length quality of known tets") {
    const Vec3 a(1, 1, 1), b(1, -1, -1), c(-1, 1, -1), d(-1, -1, 1);
    CHECK(std::abs(tet_quality(a, c, b, d)) == doctest::Approx(1.0));
    CHECK(tet_quality(a, c, b, d) == doctest::Approx(-tet_quality(a, b, c, d)));
    // Corner of a cube: the method's grid has 0.7698 there.
    CHECK(tet_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) ==
          doctest::Approx(0.7698).epsilon(1e-4));
    CHECK(tet_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}) == 0.0);
    CHECK(tet_quality({1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}) == 0.0);
    CHECK(regular_tet_volume((a - b).norm()) == doctest::Approx(std::abs(tet_volume(a, b, c, d))));
}

TEST_CASE("closest point on a triangle against dense sampling") {
    RandomStream random(RandomKey{11, 0, 0, 0});
    const auto point = [&] {
        return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    for (int i = 0; i < 300; ++i) {
        const Vec3 a = point(), b = point(), c = point(), p = 2 * point();
        double best = 1e9;
        constexpr int n = 60;
        for (int u = 0; u <= n; ++u) {
            for (int v = 0; u + v <= n; ++v) {
                best = std::min(best, (p - (a + (b - a) * u / n + (c - a) * v / n)).norm());
            }
        }
        const double found = (p - closest_point_on_triangle(p, a, b, c)).norm();
        CHECK(found <= best + 1e-12);
        CHECK(found >= best - 0.06);
    }
}

TEST_CASE("segment distance against dense sampling") {
    RandomStream random(RandomKey{12, 0, 0, 0});
    const auto point = [&] {
        return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    for (int i = 0; i < 200; ++i) {
        const Vec3 a = point(), b = point(), c = point(), d = i % 7 == 0 ? c : point();
        double best = 1e9;
        for (int u = 0; u <= 80; ++u) {
            for (int v = 0; v <= 80; ++v)
                best = std::min(best, (a + (b - a) * u / 80 - c - (d - c) * v / 80).norm());
        }
        const double found = segment_distance(a, b, c, d);
        CHECK(found <= best + 1e-12);
        CHECK(found >= best - 0.06);
    }
}
