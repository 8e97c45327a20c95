#include <limits>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/surface/intersections.hpp>

#include "cgal_judge.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::surface;

namespace {

constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

/// Compares with exactly constructed intersections and returns the number of pairs.
std::size_t judged(const TriangleMesh& m) {
    const auto mine = self_intersections(m, all);
    const auto theirs = test::cgal_soup_intersections(m);
    CHECK(mine.count == theirs.size());
    CHECK(mine.pairs == theirs);
    return mine.count;
}

/// Compares with CGAL's own search; for manifold meshes.
std::size_t judged_mesh(const TriangleMesh& m) {
    const auto mine = self_intersections(m, all);
    CHECK(mine.pairs == test::cgal_mesh_intersections(m));
    return mine.count;
}

TriangleMesh two(const std::array<Vec3, 6>& p) {
    TriangleMesh m;
    m.points.assign(p.begin(), p.end());
    m.faces = {{0, 1, 2}, {3, 4, 5}};
    return m;
}

}  // namespace

TEST_CASE("clean meshes have none") {
    CHECK(judged(test::cube()) == 0);
    for (const TriangleMesh& m : {test::cube(), test::sphere(5), test::torus(80, 40)})
        CHECK(judged_mesh(m) == 0);
    CHECK(self_intersections(TriangleMesh{}).count == 0);
}

TEST_CASE("two spheres that overlap") {
    TriangleMesh m = test::sphere(3);
    test::append(m, test::sphere(3, 1.0, {0.7, 0.1, 0.05}));
    CHECK(judged_mesh(m) > 50);
}

TEST_CASE("two cubes with a common wall overlap in their plane") {
    TriangleMesh m = test::cube();
    test::append(m, test::cube({2, 0, 0}));
    CHECK(judged(m) > 0);
    m = test::cube();
    test::append(m, test::cube({std::nextafter(2.0, 3.0), 0, 0}));
    CHECK(judged(m) == 0);
}

TEST_CASE("pairs of single triangles") {
    SUBCASE("piercing") {
        CHECK(
            judged(two(
                {Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0}})) ==
            1);
    }
    SUBCASE("vertex touches the inside") {
        CHECK(judged(two(
                  {Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 0}, {0, 0, 1}, {1, 1, 1}})) ==
              1);
    }
    SUBCASE("vertex touches an edge") {
        CHECK(judged(two(
                  {Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0, 0}, {1, -1, 1}, {1, -1, 2}})) == 1);
    }
    SUBCASE("vertices touch, different indices") {
        CHECK(judged(two(
                  {Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 0}, {-1, 0, 1}, {0, -1, 1}})) == 1);
    }
    SUBCASE("edges cross") {
        CHECK(judged(two(
                  {Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0, -1}, {1, 0, 1}, {1, -2, 0}})) == 1);
    }
    SUBCASE("one ulp above") {
        CHECK(judged(two({Vec3{0, 0, 0},
                          {2, 0, 0},
                          {0, 2, 0},
                          {0.5, 0.5, 0x1p-1040},
                          {0, 0, 1},
                          {1, 1, 1}})) == 0);
    }
    SUBCASE("coplanar, one inside the other") {
        CHECK(judged(two({Vec3{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {1, 1, 0}, {2, 1, 0}, {1, 2, 0}})) ==
              1);
    }
    SUBCASE("coplanar, crossing without a vertex inside") {
        CHECK(judged(two(
                  {Vec3{0, 0, 0}, {4, 0, 0}, {2, 4, 0}, {0, 3, 0}, {4, 3, 0}, {2, -1, 0}})) == 1);
    }
    SUBCASE("coplanar, apart") {
        CHECK(judged(two({Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {1, 2, 0}})) ==
              0);
    }
    SUBCASE("coplanar, boxes overlap, apart") {
        CHECK(judged(two({Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 3, 0}, {3, 4, 0}})) ==
              0);
    }
    SUBCASE("vertical coplanar overlap") {
        CHECK(judged(two({Vec3{0, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, 1, 1}, {0, 5, 1}, {0, 1, 5}})) ==
              1);
    }
    SUBCASE("the line meets, the segment does not") {
        CHECK(
            judged(two(
                {Vec3{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, 1}, {0.5, 0.5, 2}, {3, 3, 1}})) ==
            0);
    }
}

TEST_CASE("faces with a common vertex") {
    const auto with = [](const Vec3& c, const Vec3& d) {
        TriangleMesh m;
        m.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, c, d};
        m.faces = {{1, 2, 0}, {3, 0, 4}};
        return m;
    };
    CHECK(judged(with({-1, 0, 1}, {0, -1, 1})) == 0);
    CHECK(judged(with({1, 1, -1}, {1, 1, 1})) == 1);   // pierces
    CHECK(judged(with({-4, 0, 0}, {0, -4, 0})) == 0);  // coplanar, opposite
    CHECK(judged(with({1, 1, 0}, {2, 1, 0})) == 1);    // coplanar, inside
    CHECK(judged(with({4, -4, 0}, {4, 4, 0})) == 1);   // coplanar, over an edge
    CHECK(judged(with({1, 1, 0}, {1, 1, 5})) == 1);    // an edge lies in the face
    CHECK(judged(with({1, 0, 0}, {1, 0, 5})) == 1);    // an edge lies on an edge
    CHECK(judged(with({-1, -1, 0}, {1, 1, 5})) == 0);
    CHECK(judged(with({3, 3, -1}, {3, 3, 1})) == 1);    // reaches beyond the face, cut by it
    CHECK(judged(with({-1, 3, -1}, {-1, 3, 1})) == 0);  // passes beside it
}

TEST_CASE("faces with a common edge") {
    const auto with = [](const Vec3& d) {
        TriangleMesh m;
        m.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, d};
        m.faces = {{0, 1, 2}, {1, 0, 3}};
        return m;
    };
    CHECK(judged(with({1, -3, 0})) == 0);
    CHECK(judged(with({1, 3, 1e-300})) == 0);
    CHECK(judged(with({1, 3, 0})) == 1);
    CHECK(judged(with({-50, 1, 0})) == 1);
    CHECK(judged(with({0, 4, 0})) == 1);
}

TEST_CASE("the same face twice, either way round") {
    TriangleMesh m = test::cube();
    m.faces.push_back(m.faces[4]);
    CHECK(judged(m) == 1);
    std::swap(m.faces.back()[0], m.faces.back()[1]);
    CHECK(judged(m) == 1);
}

TEST_CASE("random soups agree with CGAL pair by pair") {
    std::size_t total = 0;
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        RandomStream random(RandomKey{seed, 2, 0, 0});
        TriangleMesh m;
        // Even seeds: points of a small integer lattice, so that coplanar, touching and degenerate
        // cases abound.
        for (int i = 0; i < 40; ++i) {
            if (seed % 2 == 0) {
                const auto c = [&] { return static_cast<double>(random.index(4)); };
                m.points.emplace_back(c(), c(), c());
            } else {
                m.points.emplace_back(random.uniform(), random.uniform(), random.uniform());
            }
        }
        while (m.faces.size() < 120) {
            const auto pick = [&] { return static_cast<std::uint32_t>(random.index(40)); };
            const std::array<std::uint32_t, 3> f = {pick(), pick(), pick()};
            if (f[0] != f[1] && f[1] != f[2] && f[2] != f[0]) m.faces.push_back(f);
        }
        total += judged(m);
    }
    CHECK(total > 10000);
}

TEST_CASE("near-touching sheets agree with CGAL") {
    std::size_t touching = 0, free = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        RandomStream random(RandomKey{seed, 3, 0, 0});
        // Two wavy sheets, an ulp or so apart, in a turned frame so that rounding decides.
        const Eigen::AngleAxisd turn(random.uniform(0, 3), Vec3(1, 2, 3).normalized());
        TriangleMesh m;
        constexpr std::uint32_t n = 8;
        for (const double lift : {0.0, static_cast<double>(seed % 6) * 1.1e-16}) {
            RandomStream wave(RandomKey{seed, 4, 0, 0});
            const auto base = static_cast<std::uint32_t>(m.points.size());
            for (std::uint32_t i = 0; i < n * n; ++i) {
                const double z = seed % 3 == 0 ? 0.0 : 0.1 * wave.uniform();
                m.points.push_back(turn *
                                   Vec3(i % n, static_cast<double>(i / n), z + lift));  // NOLINT
            }
            for (std::uint32_t i = 0; i + 1 < n; ++i) {
                for (std::uint32_t j = 0; j + 1 < n; ++j) {
                    const std::uint32_t a = base + i * n + j;
                    m.faces.push_back({a, a + 1, a + n});
                    m.faces.push_back({a + 1, a + n + 1, a + n});
                }
            }
        }
        const std::size_t count = judged_mesh(m);
        touching += count > 0 ? 1 : 0;
        free += count == 0 ? 1 : 0;
    }
    CHECK(touching > 3);
    CHECK(free > 3);
}

TEST_CASE("degenerate faces are counted and take no part") {
    TriangleMesh m = test::cube();
    m.points.emplace_back(0, 0, -5);
    m.points.emplace_back(0, 0, 0);
    m.points.emplace_back(0, 0, 5);
    m.faces.push_back({8, 9, 10});
    const auto r = self_intersections(m);
    CHECK(r.count == 0);
    CHECK(r.degenerate_faces == 1);
}

TEST_CASE("threads and the limit change nothing in the count") {
    TriangleMesh m = test::sphere(5);
    test::append(m, test::sphere(5, 1.0, {0.3, 0.2, 0.1}));
    Workers workers(3);
    const auto one = self_intersections(m, all), three = self_intersections(m, all, &workers),
               few = self_intersections(m, 5);
    CHECK(one.count == three.count);
    CHECK(one.pairs == three.pairs);
    CHECK(few.count == one.count);
    REQUIRE(few.pairs.size() == 5);
    CHECK(std::equal(few.pairs.begin(), few.pairs.end(), one.pairs.begin()));
}

TEST_CASE("unsound input is refused") {
    TriangleMesh m = test::cube();
    m.faces.push_back({0, 1, 80});
    CHECK_THROWS_AS(self_intersections(m), GeometryError);
}
