#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/distance.hpp>
#include <dsc/surface/measure.hpp>

#include "cgal_judge.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::surface;

namespace {

Vec3 random_point(RandomStream& random, double half) {
    return {random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
}

}  // namespace

TEST_CASE("nearest face against brute force") {
    const TriangleMesh m = test::torus(40, 20);
    const TriangleTree tree(m);
    RandomStream random(RandomKey{1, 0, 0, 0});
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random_point(random, 2.0);
        double best = std::numeric_limits<double>::infinity();
        std::uint32_t face = 0;
        for (std::uint32_t f = 0; f < m.faces.size(); ++f) {
            const auto& [a, b, c] = m.faces[f];
            const double d =
                (geometry::closest_point_on_triangle(p, m.points[a], m.points[b], m.points[c]) - p)
                    .squaredNorm();
            if (d < best) {
                best = d;
                face = f;
            }
        }
        const NearestHit hit = tree.nearest(p);
        CHECK(hit.distance == std::sqrt(best));
        CHECK(hit.index == face);
        CHECK((hit.point - p).norm() == hit.distance);
    }
}

TEST_CASE("nearest face against exact arithmetic, slivers and degenerate faces included") {
    TriangleMesh m;
    RandomStream random(RandomKey{2, 0, 0, 0});
    for (std::uint32_t i = 0; i < 60; ++i) {
        const Vec3 a = random_point(random, 1.0), b = random_point(random, 1.0);
        const Vec3 c = i % 3 == 0 ? random_point(random, 1.0)
                                  : Vec3(a + 0.4 * (b - a) + 1e-9 * random_point(random, 1.0));
        m.points.insert(m.points.end(), {a, b, c});
        m.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    m.points.insert(m.points.end(), {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0)});
    TriangleMesh segment;
    segment.points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    segment.faces = {{0, 1, 2}};
    CHECK(TriangleTree(segment).nearest({0.5, 1, 0}).distance ==
          doctest::Approx(1.0).epsilon(1e-15));
    const TriangleTree tree(m);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = random_point(random, 1.5);
        CHECK(tree.nearest(p).distance ==
              doctest::Approx(std::sqrt(test::cgal_squared_distance(p, m))).epsilon(1e-9));
    }
}

TEST_CASE("nearest point against brute force, ties to the lowest index") {
    std::vector<Vec3> points;
    RandomStream random(RandomKey{3, 0, 0, 0});
    for (int i = 0; i < 400; ++i) points.push_back(random_point(random, 1.0));
    for (int i = 0; i < 100; ++i) points.push_back(points[static_cast<std::size_t>(4 * i)]);
    const PointTree tree(points);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p =
            i < 100 ? points[static_cast<std::size_t>(400 + i)] : random_point(random, 1.5);
        const auto best =
            std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
                return (a - p).squaredNorm() < (b - p).squaredNorm();
            });
        const NearestHit hit = tree.nearest(p);
        CHECK(hit.index == static_cast<std::uint32_t>(best - points.begin()));
        CHECK(hit.distance == (*best - p).norm());
    }
}

TEST_CASE("millimetres survive at coordinates of 5e6") {
    const Vec3 far(5e6, 5e6, 5e6);
    const TriangleMesh m = test::cube(far, 1.0);
    CHECK(TriangleTree(m).nearest(far + Vec3(0, 0, 1.001)).distance ==
          doctest::Approx(1e-3).epsilon(1e-5));
}

TEST_CASE("samples are uniform by area and independent of the count") {
    TriangleMesh m = test::cube(Vec3::Zero(), 1.0);
    test::append(m, test::cube({10, 0, 0}, 0.5));  // a quarter of the area
    m.faces.push_back({0, 0, 1});                  // no area, never sampled
    const SurfaceSamples s = sample_surface(m, 20000, RandomKey{4, 0, 0, 0});
    std::size_t small = 0;
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < s.points.size(); ++i) {
        CHECK(s.faces[i] < 24);
        const auto& [a, b, c] = m.faces[s.faces[i]];
        const Vec3 back =
            geometry::closest_point_on_triangle(s.points[i], m.points[a], m.points[b], m.points[c]);
        if ((back - s.points[i]).norm() > 1e-14) FAIL_CHECK("sample off its face");
        if (s.points[i].x() > 5)
            ++small;
        else
            mean += s.points[i];
    }
    CHECK(std::abs(static_cast<double>(small) / 20000.0 - 0.2) < 0.01);  // 6 of 30
    CHECK((mean / static_cast<double>(20000 - small)).norm() < 0.03);
    const SurfaceSamples few = sample_surface(m, 10, RandomKey{4, 0, 0, 0});
    CHECK(std::equal(few.points.begin(), few.points.end(), s.points.begin()));
    CHECK(sample_surface(m, 10, RandomKey{5, 0, 0, 0}).points[0] != few.points[0]);
}

TEST_CASE("a surface against itself is perfect") {
    const TriangleMesh m = test::torus();
    const Evaluation e = evaluate(m, m, {5000, 7, nullptr});
    CHECK(e.chamfer < 1e-15);
    CHECK(e.hausdorff < 1e-14);
    CHECK(e.f_score_05 == 1.0);
    CHECK(e.f_score_1 == 1.0);
    CHECK(e.normal_consistency == doctest::Approx(1.0));
}

TEST_CASE("two concentric spheres") {
    const TriangleMesh truth = test::sphere(6);
    Workers workers(2);
    for (const double gap : {0.012, 0.03, 0.05}) {
        const TriangleMesh recon = test::sphere(6, 1.0 + gap);
        const Evaluation e = evaluate(recon, truth, {20000, 7, &workers});
        const double diagonal = 2.0 * std::sqrt(3.0);
        const double expected = gap / diagonal;
        CHECK(e.diagonal == doctest::Approx(diagonal));
        CHECK(e.accuracy == doctest::Approx(expected).epsilon(0.01));
        CHECK(e.completeness == doctest::Approx(expected).epsilon(0.01));
        CHECK(e.chamfer == doctest::Approx(0.5 * (e.accuracy + e.completeness)));
        CHECK(e.hausdorff >= e.hausdorff99);
        CHECK(e.hausdorff99 == doctest::Approx(expected).epsilon(0.03));
        CHECK(e.f_score_05 == (expected < 0.005 ? 1.0 : 0.0));
        CHECK(e.f_score_1 == (expected < 0.01 ? 1.0 : 0.0));
        CHECK(e.normal_consistency > 0.999);
        const Evaluation again = evaluate(recon, truth, {20000, 7, nullptr});
        CHECK(again.chamfer == e.chamfer);
        CHECK(again.hausdorff == e.hausdorff);
    }
}

TEST_CASE("half of a surface is accurate but not complete") {
    const TriangleMesh truth = test::cube();
    TriangleMesh half = truth;
    half.faces.erase(half.faces.begin() + 2, half.faces.end());  // the square z = -1
    const Evaluation e = evaluate(half, truth, {20000, 7, nullptr});
    CHECK(e.accuracy < 1e-15);
    // Per side wall the mean distance is 1, on the opposite square 2.
    CHECK(e.completeness * e.diagonal == doctest::Approx((4 * 1.0 + 2.0) / 6.0).epsilon(0.02));
    CHECK(e.f_score_1 == doctest::Approx(2 * 0.178 / 1.178).epsilon(0.03));
}

TEST_CASE("a surface against the cloud it came from") {
    TriangleMesh m = test::cube();
    m.points.emplace_back(50, 50, 50);  // no face uses it
    const std::vector<Vec3> cloud = {{1, 1, 1.5}, {-1, -1, -1.25}, {0, 0, 3}};
    const CloudEvaluation e = evaluate_cloud(m, cloud);
    CHECK(e.vertex_to_cloud.min == doctest::Approx(0.25));
    const double same = std::sqrt(4 + 0.25), low = std::sqrt(4 + 0.0625);
    // Top: 0.5, two at (2, 0.5), one 2.25 above the second point; bottom: 0.25, two at (2, 0.25),
    // one 2.5 below the first.
    const double top_far = 2.25, bottom_far = 2.5;
    CHECK(e.vertex_to_cloud.mean ==
          doctest::Approx((0.5 + 2 * same + top_far + 0.25 + 2 * low + bottom_far) / 8));
    CHECK(e.vertex_to_cloud.max == doctest::Approx(bottom_far));
    CHECK(e.cloud_to_surface.mean == doctest::Approx((0.5 + 0.25 + 2.0) / 3));
    CHECK(e.cloud_to_surface.max == doctest::Approx(2.0));
    CHECK(e.cloud_to_surface.min == doctest::Approx(0.25));
}

TEST_CASE("nothing to measure is an error") {
    const TriangleMesh m = test::cube();
    CHECK_THROWS_WITH_AS(TriangleTree(TriangleMesh{}),
                         "surface: the mesh has no faces; at least one is needed for a distance",
                         GeometryError);
    CHECK_THROWS_WITH_AS(evaluate_cloud(m, {}),
                         "points: the set is empty; at least one point is needed for a distance",
                         GeometryError);
    TriangleMesh flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    flat.faces = {{0, 1, 2}};
    CHECK_THROWS_WITH_AS(
        evaluate(flat, m),
        "surface: the mesh has no area to sample; provide at least one face that is not degenerate",
        GeometryError);
    const std::vector<Vec3> bad = {{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}};
    CHECK_THROWS_WITH_AS(PointTree{bad}, "points: point 1 is NaN or infinite; remove it",
                         GeometryError);
    CHECK_THROWS_AS(evaluate(m, m, {0, 7, nullptr}), UsageError);
}
