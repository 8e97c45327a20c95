#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/decimate.hpp>
#include <dsc/surface/distance.hpp>

#include "shapes.hpp"

using namespace dsc;
using namespace dsc::surface;

TEST_CASE("decimation keeps closed surfaces closed, near and of their genus") {
    TriangleMesh m = test::torus(120, 60);
    test::append(m, test::sphere(5, 0.5, {3, 0, 0}));
    for (const std::size_t target : {8000U, 2000U, 600U}) {
        const TriangleMesh less = decimate(m, target);
        const SurfaceReport r = analyse(less);
        CHECK(r.faces <= target);
        CHECK(r.faces > target - 10);
        CHECK(r.closed_manifold());
        CHECK(r.shells == 2);
        CHECK(r.genus == 1);
        CHECK(r.unused_points == 0);
        const Evaluation e = evaluate(less, m, {4000, 7, nullptr});
        CHECK(e.hausdorff < 0.02);
        CHECK(e.chamfer < 0.004);
    }
}

TEST_CASE("decimation far from the origin and of an open sheet") {
    TriangleMesh m = test::sphere(4, 1.0, {5e6, 5e6, 5e6});
    const TriangleMesh less = decimate(m, 300);
    CHECK(evaluate(less, m, {2000, 7, nullptr}).hausdorff < 0.03);
    m.faces.resize(m.faces.size() / 2);
    const SurfaceReport before = analyse(m), after = analyse(decimate(m, 300));
    CHECK(after.faces <= 300);
    CHECK(after.shells == before.shells);
    CHECK(after.shell_reports[0].boundary_loops == before.shell_reports[0].boundary_loops);
}

TEST_CASE("decimation never goes below what the topology needs, and changes nothing when there is "
          "nothing to do") {
    const TriangleMesh m = test::sphere(2);
    CHECK(decimate(m, m.faces.size()).points == m.points);
    const SurfaceReport least = analyse(decimate(m, 0));
    CHECK(least.faces >= 4);
    CHECK(least.closed_manifold());
    CHECK(decimate(m, 50).points == decimate(m, 50).points);
}

TEST_CASE("decimation refuses what half-edges cannot hold") {
    TriangleMesh m = test::cube();
    m.faces.push_back(m.faces[3]);
    CHECK_THROWS_WITH_AS(decimate(m, 4),
                         "decimate: the surface has 3 non-manifold edges, 3 edges used twice in "
                         "one direction, 0 non-manifold "
                         "vertices and 0 faces that use a point twice; repair the surface first",
                         GeometryError);
}
