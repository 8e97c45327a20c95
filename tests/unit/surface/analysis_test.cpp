#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/surface/analysis.hpp>

#include "shapes.hpp"

using namespace dsc;
using namespace dsc::surface;

namespace {

void check_closed_manifold(const SurfaceReport& r) {
    CHECK(r.closed_manifold());
    CHECK(r.boundary_edges == 0);
    CHECK(r.nonmanifold_edges == 0);
    CHECK(r.nonmanifold_vertices == 0);
    CHECK(r.misoriented_edges == 0);
}

/// Strip of n quadrilaterals that is closed with half a twist or without.
TriangleMesh band(std::uint32_t n, bool twist) {
    TriangleMesh m;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double u = 2 * std::numbers::pi * i / n;
        for (const double s : {-0.3, 0.3}) {
            const double half = twist ? u / 2 : 0.0;
            const double r = 1 + s * std::cos(half);
            m.points.emplace_back(r * std::cos(u), r * std::sin(u),
                                  s * std::sin(half) + (twist ? 0.0 : s));
        }
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * i + 1;
        std::uint32_t c = (2 * i + 2) % (2 * n), d = (2 * i + 3) % (2 * n);
        if (twist && i + 1 == n) std::swap(c, d);
        m.faces.push_back({a, c, b});
        m.faces.push_back({b, c, d});
    }
    return m;
}

}  // namespace

TEST_CASE("cube") {
    const SurfaceReport r = analyse(test::cube());
    check_closed_manifold(r);
    CHECK(r.vertices == 8);
    CHECK(r.edges == 18);
    CHECK(r.faces == 12);
    CHECK(r.euler == 2);
    CHECK(r.shells == 1);
    CHECK(r.components == 1);
    CHECK(r.cavities == 0);
    CHECK(r.genus == 0);
    CHECK(r.volume == doctest::Approx(8.0));
    CHECK(r.area == doctest::Approx(24.0));
    CHECK(r.edge_min == 2.0);
    CHECK(r.edge_max == doctest::Approx(std::sqrt(8.0)));
    CHECK(r.edge_mean == doctest::Approx((12 * 2 + 6 * std::sqrt(8.0)) / 18));
    CHECK(r.box.low == Vec3(-1, -1, -1));
    CHECK(r.box.high == Vec3(1, 1, 1));
}

TEST_CASE("torus has genus 1") {
    const SurfaceReport r = analyse(test::torus());
    check_closed_manifold(r);
    CHECK(r.euler == 0);
    CHECK(r.genus == 1);
    CHECK(r.volume == doctest::Approx(2 * std::pow(std::numbers::pi, 2) * 0.16).epsilon(0.08));
}

TEST_CASE("two spheres and a torus: shells, components, summed genus") {
    TriangleMesh m = test::sphere(2, 1.0, {-3, 0, 0});
    test::append(m, test::torus());
    test::append(m, test::sphere(1, 0.5, {3, 0, 0}));
    const SurfaceReport r = analyse(m);
    check_closed_manifold(r);
    CHECK(r.shells == 3);
    CHECK(r.components == 3);
    CHECK(r.genus == 1);
    REQUIRE(r.shell_reports.size() == 3);
    CHECK(r.shell_reports[0].faces == 128);
    CHECK(r.shell_reports[0].genus == 0);
    CHECK(r.shell_reports[1].genus == 1);
    CHECK(r.shell_reports[2].faces == 32);
}

TEST_CASE("a cavity has negative volume") {
    TriangleMesh m = test::cube(Vec3::Zero(), 1.0);
    test::append(m, test::inside_out(test::cube(Vec3::Zero(), 0.5)));
    const SurfaceReport r = analyse(m);
    check_closed_manifold(r);
    CHECK(r.shells == 2);
    CHECK(r.components == 1);
    CHECK(r.cavities == 1);
    CHECK(r.volume == doctest::Approx(7.0));
    CHECK(r.shell_reports[1].volume == doctest::Approx(-1.0));
}

TEST_CASE("bow-tie: two tetrahedra on one vertex are two shells") {
    TriangleMesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    m.faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
               {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}};
    const SurfaceReport r = analyse(m);
    CHECK_FALSE(r.closed_manifold());
    CHECK(r.nonmanifold_vertices == 1);
    CHECK(r.nonmanifold_edges == 0);
    CHECK(r.boundary_edges == 0);
    CHECK(r.misoriented_edges == 0);
    CHECK(r.shells == 2);
    CHECK(r.genus == 0);
    CHECK(r.euler == 3);  // 7 - 12 + 8
    CHECK(r.shell_reports[0].euler == 2);
    CHECK(std::abs(r.shell_reports[0].volume) == doctest::Approx(1.0 / 6.0));
}

TEST_CASE("two cubes on one edge: one shell with a non-manifold edge, closed all the same") {
    TriangleMesh m = test::cube();
    const TriangleMesh other = test::cube({2, 2, 0});
    // Points 0 and 4 of the second cube are points 3 and 7 of the first.
    const auto moved = [](std::uint32_t v) { return v == 0 ? 3U : v == 4 ? 7U : v + 8U; };
    m.points.insert(m.points.end(), other.points.begin(), other.points.end());
    for (const auto& [a, b, c] : other.faces) m.faces.push_back({moved(a), moved(b), moved(c)});
    const SurfaceReport r = analyse(m);
    CHECK(r.nonmanifold_edges == 1);
    CHECK(r.misoriented_edges == 2);
    CHECK(r.boundary_edges == 0);
    CHECK(r.unused_points == 2);
    CHECK(r.shells == 1);
    CHECK(r.shell_reports[0].closed);
    CHECK_FALSE(r.shell_reports[0].manifold);
    CHECK(r.volume == doctest::Approx(16.0));
    CHECK(r.components == 1);
}

TEST_CASE("boundaries: a cube without a face, an annulus, a disc") {
    TriangleMesh m = test::cube();
    m.faces.pop_back();
    SurfaceReport r = analyse(m);
    CHECK(r.boundary_edges == 3);
    CHECK(r.shell_reports[0].boundary_loops == 1);
    CHECK_FALSE(r.shell_reports[0].closed);
    CHECK(r.volume == 0.0);
    CHECK(r.components == 0);
    CHECK(r.genus == 0);

    r = analyse(band(12, false));
    CHECK(r.boundary_edges == 24);
    CHECK(r.misoriented_edges == 0);
    CHECK(r.shell_reports[0].boundary_loops == 2);
    CHECK(r.shell_reports[0].manifold);
    CHECK(r.genus == 0);

    TriangleMesh torus = test::torus();
    torus.faces.erase(torus.faces.begin());
    r = analyse(torus);
    CHECK(r.shell_reports[0].boundary_loops == 1);
    CHECK(r.genus == 1);
}

TEST_CASE("Moebius strip cannot be oriented") {
    const SurfaceReport r = analyse(band(12, true));
    CHECK(r.misoriented_edges >= 1);
    CHECK(r.nonmanifold_edges == 0);
    CHECK(r.boundary_edges == 24);
    CHECK(r.shells == 1);
    CHECK_FALSE(r.shell_reports[0].manifold);
    CHECK(r.genus == 0);
}

TEST_CASE("one face turned round: three directed edges are used twice") {
    TriangleMesh m = test::sphere(2);
    std::swap(m.faces[17][0], m.faces[17][1]);
    const SurfaceReport r = analyse(m);
    CHECK(r.misoriented_edges == 3);
    CHECK(r.boundary_edges == 0);
    CHECK_FALSE(r.closed_manifold());
    CHECK(r.volume == 0.0);
}

TEST_CASE("duplicate, degenerate and invalid faces, duplicate and unused points are counted") {
    TriangleMesh m = test::cube();
    m.faces.push_back({3, 0, 2});   // the first face again
    m.faces.push_back({5, 5, 1});   // uses a point twice
    m.faces.push_back({0, 1, 99});  // no such point
    m.points.push_back(m.points[0]);
    m.points.emplace_back(0, 0, 0);
    m.points.emplace_back(std::numeric_limits<double>::infinity(), 0, 0);
    m.faces.push_back({0, 1, 10});
    m.points.emplace_back(2, 0, 0);
    m.points.emplace_back(4, 0, 0);
    m.faces.push_back({9, 11, 12});  // collinear
    m.faces.push_back({8, 11, 9});
    const SurfaceReport r = analyse(m);
    CHECK(r.duplicate_faces == 1);
    CHECK(r.degenerate_faces == 2);
    CHECK(r.invalid_faces == 2);
    CHECK(r.duplicate_points == 1);
    CHECK(r.unused_points == 1);
    CHECK(r.faces == 12 + 1 + 1 + 1);
    CHECK(r.shells == 2);
}

TEST_CASE("empty mesh") {
    const SurfaceReport r = analyse(TriangleMesh{});
    CHECK(r.shells == 0);
    CHECK(r.box.empty());
    CHECK(r.edge_min == 0.0);
    CHECK_FALSE(r.closed_manifold());
}

TEST_CASE("random garbage is counted consistently") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        RandomStream random(RandomKey{seed, 1, 0, 0});
        TriangleMesh m;
        const std::size_t points = random.index(12);
        for (std::size_t i = 0; i < points; ++i) {
            const double x =
                random.index(9) == 0 ? std::numeric_limits<double>::quiet_NaN() : random.normal();
            m.points.emplace_back(x, random.normal(), 1e300 * random.normal());
        }
        for (int i = 0; i < 40; ++i) {
            const auto pick = [&] { return static_cast<std::uint32_t>(random.index(14)); };
            m.faces.push_back({pick(), pick(), pick()});
        }
        const SurfaceReport r = analyse(m);
        std::size_t vertices = 0, edges = 0, faces = 0;
        for (const ShellReport& shell : r.shell_reports) {
            vertices += shell.vertices;
            edges += shell.edges;
            faces += shell.faces;
        }
        CHECK(faces == r.faces);
        CHECK(edges == r.edges);
        CHECK(vertices >= r.vertices);
        CHECK((vertices == r.vertices) == (r.nonmanifold_vertices == 0));
        CHECK(r.vertices + r.unused_points == m.points.size());
        CHECK(r.faces + r.invalid_faces <= m.faces.size());
    }
}
