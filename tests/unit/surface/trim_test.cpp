#include <cmath>
#include <functional>
#include <numbers>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/measure.hpp>
#include <dsc/surface/trim.hpp>

#include "shapes.hpp"

using namespace dsc;
using namespace dsc::surface;

namespace {

std::vector<double> values_of(const TriangleMesh& mesh,
                              const std::function<double(const Vec3&)>& f) {
    std::vector<double> out;
    for (const Vec3& p : mesh.points) out.push_back(f(p));
    return out;
}

void check_sheet(const TriangleMesh& mesh) {
    const SurfaceReport r = analyse(mesh);
    CHECK(r.nonmanifold_edges == 0);
    CHECK(r.nonmanifold_vertices == 0);
    CHECK(r.misoriented_edges == 0);
    CHECK(r.duplicate_faces == 0);
    CHECK(r.unused_points == 0);
}

}  // namespace

TEST_CASE("the half of a ball that points support is a disc") {
    const TriangleMesh ball = test::sphere(4);
    TrimReport report;
    std::vector<std::uint32_t> points_of;
    const TriangleMesh half =
        trim(ball, values_of(ball, [](const Vec3& p) { return p.z() > 0.0 ? 0.3 : 5.0; }), {}, {},
             &points_of, &report);
    check_sheet(half);
    const SurfaceReport r = analyse(half);
    REQUIRE(r.shells == 1);
    CHECK(r.shell_reports[0].boundary_loops == 1);
    CHECK(r.euler == 1);
    CHECK(r.area == doctest::Approx(2.0 * std::numbers::pi).epsilon(0.1));
    CHECK(report.faces == ball.faces.size() - half.faces.size());
    CHECK(report.area_share == doctest::Approx(1.0 - r.area / analyse(ball).area));
    REQUIRE(points_of.size() == half.points.size());
    for (std::size_t i = 0; i < points_of.size(); ++i)
        CHECK(half.points[i] == ball.points[points_of[i]]);
}

TEST_CASE("the border moves back to where points are near") {
    const TriangleMesh ball = test::sphere(4);
    // Gaps grow with the depth below the equator, up to 4: from 1 on they go, as they lie next to
    // those above 2.
    const TriangleMesh part =
        trim(ball, values_of(ball, [](const Vec3& p) { return std::max(0.0, -4.0 * p.z()); }), {});
    double lowest = 1.0;
    for (const Vec3& p : part.points) lowest = std::min(lowest, p.z());
    CHECK(lowest > -0.25 - 1e-12);
    CHECK(lowest < -0.1);
    // The same gap stays where nothing farther away touches it.
    CHECK(trim(ball, values_of(ball, [](const Vec3& p) { return std::max(0.0, -1.9 * p.z()); }), {})
              .faces.size() == ball.faces.size());
}

TEST_CASE("small islands go, large pieces stay") {
    const TriangleMesh ball = test::sphere(5);
    const auto gap = [](const Vec3& p) {
        const bool cap = p.z() > 0.3, other = p.z() < -0.5,
                   speck = (p - Vec3(1, 0, 0)).norm() < 0.12;
        return cap || other || speck ? 0.0 : 9.0;
    };
    TrimReport report;
    const TriangleMesh part = trim(ball, values_of(ball, gap), {}, {}, nullptr, &report);
    check_sheet(part);
    CHECK(analyse(part).shells == 2);
    CHECK(report.islands == 1);
}

TEST_CASE("support decides where it is asked for") {
    const TriangleMesh ball = test::sphere(3);
    const std::vector<double> near(ball.points.size(), 0.0);
    const auto support = values_of(ball, [](const Vec3& p) { return p.x() > 0.0 ? 1.0 : 0.2; });
    CHECK(trim(ball, near, support).faces.size() == ball.faces.size());
    const TriangleMesh half = trim(ball, near, support, {2.0, 0.5});
    CHECK(half.faces.size() < 0.55 * static_cast<double>(ball.faces.size()));
    for (const Vec3& p : half.points) CHECK(p.x() > 0.0);
}

TEST_CASE("whatever is cut off, a manifold stays manifold") {
    const TriangleMesh ball = test::sphere(4);
    RandomStream random(RandomKey{5, 0, 0, 0});
    for (int round = 0; round < 40; ++round) {
        std::vector<double> gaps(ball.points.size());
        const double share = random.uniform(0.0, 0.5);
        for (double& gap : gaps) gap = random.uniform() < share ? random.uniform(0.0, 6.0) : 0.0;
        check_sheet(trim(ball, gaps, {}));
    }
}

TEST_CASE("nothing is near: nothing is left; all is near: all stays, colours too") {
    TriangleMesh ball = test::sphere(2);
    ball.colours.assign(ball.points.size(), {1, 2, 3});
    CHECK(trim(ball, std::vector<double>(ball.points.size(), 7.0), {}).faces.empty());
    const TriangleMesh all = trim(ball, std::vector<double>(ball.points.size(), 0.0), {});
    CHECK(all.points == ball.points);
    CHECK(all.faces == ball.faces);
    CHECK(all.colours == ball.colours);
    // A value that is not a number supports nothing.
    CHECK(trim(ball, std::vector<double>(ball.points.size(), std::nan("")), {}).faces.empty());
    CHECK_THROWS_AS(trim(ball, std::vector<double>(3, 0.0), {}), GeometryError);
    CHECK_THROWS_AS(
        trim(ball, std::vector<double>(ball.points.size(), 0.0), std::vector<double>(2, 1.0)),
        GeometryError);
}
