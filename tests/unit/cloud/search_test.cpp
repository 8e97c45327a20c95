#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/cloud/target.hpp>

#include "files.hpp"

using dsc::Vec3;
using dsc::cloud::NearestSearch;
using dsc::cloud::Neighbour;

namespace {

double squared(const Vec3& a, const Vec3& b) {
    const double x = a.x() - b.x(), y = a.y() - b.y(), z = a.z() - b.z();
    return x * x + y * y + z * z;
}

/// All points by squared distance, then index.
std::vector<Neighbour> brute_force(const std::vector<Vec3>& points, const Vec3& p) {
    std::vector<Neighbour> all;
    for (std::size_t i = 0; i < points.size(); ++i)
        all.push_back({static_cast<std::uint32_t>(i), squared(points[i], p)});
    std::sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
        return a.distance < b.distance || (a.distance == b.distance && a.index < b.index);
    });
    for (Neighbour& n : all) n.distance = std::sqrt(n.distance);
    return all;
}

bool same(const std::vector<Neighbour>& a, const std::vector<Neighbour>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Neighbour& x, const Neighbour& y) {
                          return x.index == y.index && x.distance == y.distance;
                      });
}

std::vector<Neighbour> first(const std::vector<Neighbour>& all, std::size_t count) {
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()))};
}

/// Every kind of query against a scan of all points.
void compare(const std::vector<Vec3>& points, const std::vector<Vec3>& queries) {
    const NearestSearch search(points);
    std::vector<Neighbour> found;
    for (const Vec3& q : queries) {
        const std::vector<Neighbour> all = brute_force(points, q);
        REQUIRE(same({search.nearest(q)}, first(all, 1)));
        for (const std::size_t k : {std::size_t{1}, std::size_t{7}, points.size() + 3}) {
            search.k_nearest(q, k, found);
            REQUIRE(same(found, first(all, k)));
        }
        for (const double radius :
             {all[0].distance, all[all.size() / 2].distance, all.back().distance * 2.0}) {
            search.neighbours_within(q, radius, found);
            std::size_t count = 0;
            while (count < all.size() && all[count].distance <= radius) ++count;
            REQUIRE(same(found, first(all, count)));
            REQUIRE(search.within(q, radius));
        }
        if (all[0].distance > 0.0) {
            const double less = std::nextafter(all[0].distance, 0.0);
            REQUIRE_FALSE(search.within(q, less));
            search.neighbours_within(q, less, found);
            REQUIRE(found.empty());
        }
        REQUIRE_FALSE(search.within(q, -1.0));
    }
}

std::vector<Vec3> random_points(std::size_t count, std::uint64_t seed, double low = 0.0,
                                double high = 1.0) {
    dsc::RandomStream random({seed, 0, 0, 0});
    std::vector<Vec3> points(count);
    for (Vec3& p : points)
        for (int k = 0; k < 3; ++k) p[k] = random.uniform(low, high);
    return points;
}

}  // namespace

TEST_CASE("the search agrees with brute force") {
    SUBCASE("random points, queries inside and far outside") {
        const auto points = random_points(700, 1);
        compare(points, random_points(60, 2, -0.2, 1.2));
        compare(points, random_points(10, 3, -1e4, 1e4));
        compare(points, {points.begin(), points.begin() + 30});
    }
    SUBCASE("few points") {
        for (std::size_t n = 1; n < 20; ++n) compare(random_points(n, 4 + n), random_points(10, 5));
    }
    SUBCASE("clusters of very different sizes") {
        std::vector<Vec3> points;
        for (std::uint64_t c = 0; c < 10; ++c)
            for (const Vec3& p : random_points(50, 10 + c))
                points.push_back(Vec3::Constant(static_cast<double>(c)) +
                                 p * std::pow(10.0, -static_cast<double>(c)));
        compare(points, random_points(40, 30, 0.0, 10.0));
        compare(points, {points[499], points[460], points[301]});
    }
    SUBCASE("repeated points: the lowest index") {
        std::vector<Vec3> points = random_points(40, 40);
        for (std::size_t i = 0; i < 160; ++i) points.push_back(Vec3(points[i]));
        compare(points, random_points(40, 41));
        compare(points, {points.begin(), points.begin() + 40});
        compare(std::vector<Vec3>(100, Vec3(1, 2, 3)), {{1, 2, 3}, {0, 0, 0}});
    }
    SUBCASE("a grid, with ties at every half step") {
        std::vector<Vec3> points;
        for (int x = 0; x < 8; ++x)
            for (int y = 0; y < 8; ++y)
                for (int z = 0; z < 8; ++z) points.emplace_back(7 - x, y, 7 - z);
        std::vector<Vec3> queries;
        for (int i = 0; i < 60; ++i)
            queries.emplace_back(i % 15 * 0.5, i * 7 % 15 * 0.5, i * 11 % 17 * 0.5 - 0.5);
        compare(points, queries);
    }
    SUBCASE("far from the origin, a micrometre apart") {
        const Vec3 far(5e6, -5e6, 5e6);
        std::vector<Vec3> points = random_points(500, 50),
                          queries = random_points(50, 51, -0.5, 1.5);
        for (Vec3& p : points) p = far + p * 1e-3;
        for (Vec3& q : queries) q = far + q * 1e-3;
        compare(points, queries);
        compare(points, random_points(10, 52));
    }
    SUBCASE("on a line and on a plane") {
        std::vector<Vec3> points = random_points(300, 60);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].z() = 0.0;
            if (i < 150) points[i].y() = 0.0;
        }
        compare(points, random_points(40, 61));
    }
}

TEST_CASE("a search may be used by several threads at once") {
    const auto points = random_points(5000, 70);
    const auto queries = random_points(4000, 71, -0.1, 1.1);
    const NearestSearch search(points);
    std::vector<Neighbour> serial(queries.size()), parallel(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) serial[i] = search.nearest(queries[i]);
    dsc::Workers workers(4);
    workers.for_blocks(queries.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) parallel[i] = search.nearest(queries[i]);
    });
    CHECK(same(serial, parallel));
}

TEST_CASE("a search keeps its own points and can be moved") {
    std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}};
    NearestSearch original(points);
    points.assign(2, Vec3(9, 9, 9));
    const NearestSearch moved(std::move(original));
    CHECK(moved.nearest({0.9, 0, 0}).index == 1);
    CHECK(moved.points()[1] == Vec3(1, 0, 0));
    std::vector<Neighbour> none{{1, 1.0}};
    moved.k_nearest({0, 0, 0}, 0, none);
    CHECK(none.empty());
}

TEST_CASE("a search refuses what it cannot hold") {
    const std::vector<Vec3> none,
        infinite{{0, 0, 0}, {0, std::numeric_limits<double>::infinity(), 0}};
    CHECK(test::error_of([&] { NearestSearch{none}; }) ==
          "cloud.empty 5: nearest-point search: no points; a search needs at least one");
    CHECK(test::error_of([&] { NearestSearch{infinite}; }) ==
          "cloud.non_finite 5: nearest-point search: point 1 is not finite; remove it first");
}

TEST_CASE(
    "the neighbour distance of a point is the distance to its sixth neighbour, points in one place "
    "counting once") {
    // A square lattice: four neighbours at 1, four at sqrt 2, each point three times.
    dsc::cloud::Normalized lattice;
    for (int copy = 0; copy < 3; ++copy)
        for (int i = 0; i < 7; ++i)
            for (int j = 0; j < 7; ++j) lattice.points.emplace_back(i, j, 0);
    const dsc::cloud::TargetCloud target(lattice);
    CHECK(target.neighbour_distance(3 * 7 + 3) == doctest::Approx(std::sqrt(2.0)));
    // the corner: 1 1 sqrt2 2 2 sqrt5 sqrt5
    CHECK(target.neighbour_distance(0) == doctest::Approx(std::sqrt(5.0)));
    dsc::cloud::Normalized pair;
    pair.points = {Vec3(0, 0, 0), Vec3(0, 0, 2), Vec3(0, 0, 2)};
    CHECK(dsc::cloud::TargetCloud(pair).neighbour_distance(0) == 2.0);
    CHECK(dsc::cloud::TargetCloud(pair).neighbour_distance(1) == 2.0);
}
