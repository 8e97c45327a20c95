#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/generate/graded_lattice.hpp>
#include <dsc/generate/topology_filter.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

#include "implicit.hpp"

using namespace dsc;
using namespace dsc::mesh;
using namespace dsc::generate;

namespace {

using Leaf = GradedLattice::Leaf;

LatticeOptions with_cell(double cell, Vec3 centre = Vec3::Zero()) {
    LatticeOptions options;
    options.cell = cell;
    options.box = 1.5;
    options.box_centre = centre;
    return options;
}

// Places on a sphere, in clusters of sizes from `least` to ten times that.
std::vector<CellSize> uneven_sizes(double least, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<CellSize> out;
    while (out.size() < count) {
        Vec3 x(uniform(random), uniform(random), uniform(random));
        if (x.norm() < 0.1) continue;
        x *= 0.5 / x.norm();
        out.push_back({x, least * std::pow(10.0, x[0] + 0.5)});
    }
    return out;
}

Vec3 low_of(const GradedLattice& l, const Leaf& leaf) { return l.points()[leaf.vertices[0]]; }

// Whether the leaf reaches into the open box.
bool overlaps(const GradedLattice& l, const Leaf& leaf, const Vec3& low, double edge) {
    const Vec3 at = low_of(l, leaf);
    const double little = 1e-9;
    return ((at.array() + leaf.edge > low.array() + little) &&
            (at.array() < low.array() + edge - little))
        .all();
}

void check_tets(const GradedLattice& l) {
    const auto tets = l.tets();
    double volume = 0;
    std::vector<bool> used(l.points().size(), false);
    bool positive = true;
    double least_quality = 1;
    for (const auto& t : tets) {
        const auto p = l.points();
        least_quality =
            std::min(least_quality, geometry::tet_quality(p[t[0]], p[t[1]], p[t[2]], p[t[3]]));
        positive = positive && geometry::orient3d(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) > 0;
        volume +=
            std::abs((p[t[1]] - p[t[0]]).dot((p[t[2]] - p[t[0]]).cross(p[t[3]] - p[t[0]]))) / 6;
        for (const std::uint32_t v : t) used[v] = true;
    }
    CHECK(positive);
    CHECK(least_quality > 0.3);
    CHECK(volume == doctest::Approx(l.box().size().prod()).epsilon(1e-9));
    CHECK(std::count(used.begin(), used.end(), false) == 0);
}

Complex adopted(const GradedLattice& l) {
    TetMesh mesh;
    mesh.points.assign(l.points().begin(), l.points().end());
    mesh.tets = l.tets();
    for (const auto& t : mesh.tets) {
        const Vec3 middle =
            (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]] + mesh.points[t[3]]) / 4;
        mesh.labels.push_back(middle.norm() < 0.45 ? 1 : 0);
    }
    AdoptReport report;
    Complex out = adopt(mesh, "test", &report);
    CHECK(report.reoriented_tets == 0);
    CHECK(report.dropped_vertices == 0);
    return out;
}

}  // namespace

TEST_CASE("cells at a place and beside it are as small as the place asks, whatever the order of "
          "the places") {
    std::vector<CellSize> sizes = uneven_sizes(0.02, 150, 3);
    const GradedLattice l(with_cell(0.017, Vec3(0.1, 0, -0.2)), sizes, "test");
    CHECK(l.finest_cell() == doctest::Approx(0.017).epsilon(1e-12));
    CHECK((l.box().size().array() >= 3 - 1e-12).all());
    CHECK((l.box().size().array() < 3 * 1.2).all());
    CHECK((l.box().centre() - Vec3(0.1, 0, -0.2)).norm() < 1e-12);
    double smallest = 10, largest = 0;
    for (const CellSize& size : sizes) {
        double edge = l.finest_cell();
        while (2 * edge <= size.cell) edge *= 2;
        // The cell of this size that contains the place, and one more on each side.
        const Vec3 low =
            l.box().low + edge * (((size.place - l.box().low) / edge).array().floor() - 1).matrix();
        for (const Leaf& leaf : l.leaves()) {
            if (!overlaps(l, leaf, low, 3 * edge)) continue;
            REQUIRE(leaf.edge <= size.cell);
        }
    }
    for (const Leaf& leaf : l.leaves()) {
        smallest = std::min(smallest, leaf.edge);
        largest = std::max(largest, leaf.edge);
    }
    CHECK(smallest == l.finest_cell());
    CHECK(largest / smallest >= 10);

    std::shuffle(sizes.begin(), sizes.end(), std::mt19937(9));
    const GradedLattice again(with_cell(0.017, Vec3(0.1, 0, -0.2)), sizes, "test");
    CHECK(again.tets() == l.tets());
    CHECK(std::equal(l.points().begin(), l.points().end(), again.points().begin(),
                     again.points().end()));
}

TEST_CASE(
    "cells that share a corner differ by at most a factor of two, also after cells were divided") {
    GradedLattice l(with_cell(0.04), std::vector<CellSize>{{Vec3(0.31, 0.2, 0.7), 0.04}}, "test");
    std::mt19937 random(5);
    for (int round = 0; round < 4; ++round) {
        std::size_t unbalanced = 0;
        for (const Leaf& a : l.leaves()) {
            for (const Leaf& b : l.leaves()) {
                if (a.edge < 2.5 * b.edge) continue;
                const double little = 1e-9;
                const Vec3 la = low_of(l, a), lb = low_of(l, b);
                const bool touch = ((lb.array() <= la.array() + a.edge + little) &&
                                    (lb.array() + b.edge >= la.array() - little))
                                       .all();
                unbalanced += touch ? 1 : 0;
            }
        }
        CHECK(unbalanced == 0);
        const auto target = static_cast<std::uint32_t>(random() % l.leaves().size());
        l.split(std::array{target});
    }
}

TEST_CASE("tets of a lattice with sizes of 10:1 are positive, conforming and fill the box") {
    const GradedLattice l(with_cell(0.03), uneven_sizes(0.03, 400, 4), "test");
    check_tets(l);
    const Complex c = adopted(l);
    const ComplexReport report = validate(c);
    CHECK(report.faults == std::vector<std::string>{});
    CHECK(report.inverted_tets == 0);
}

TEST_CASE("dividing cells only adds vertices, so values survive; volumes add up to the box") {
    const auto value = [](const Vec3& x) { return implicit::torus(x, 0.5, 0.2); };
    GradedLattice l(with_cell(0.021), std::vector<CellSize>{{Vec3(1.49, 1.49, 1.49), 0.05}},
                    "test");
    std::vector<Vec3> points;
    std::vector<double> values;
    std::size_t rounds = 0;
    for (std::size_t old = 0; old < l.points().size(); ++rounds) {
        REQUIRE(std::equal(points.begin(), points.end(), l.points().begin()));
        REQUIRE(old == points.size());
        for (std::size_t v = old; v < l.points().size(); ++v)
            values.push_back(value(l.points()[v]));
        points.assign(l.points().begin(), l.points().end());
        const std::vector<double> volumes = l.volumes();
        CHECK(std::accumulate(volumes.begin(), volumes.end(), 0.0) ==
              doctest::Approx(l.box().size().prod()));
        old = l.split_where(
            [&](const Leaf& leaf) { return has_mixed_signs(leaf, values) && leaf.edge > 0.04; });
    }
    CHECK(rounds >= 3);
    for (std::size_t v = 0; v < values.size(); ++v) REQUIRE(values[v] == value(l.points()[v]));
    for (const Leaf& leaf : l.leaves()) {
        // x runs fastest, the centre is last.
        REQUIRE(
            (l.points()[leaf.vertices[1]] - l.points()[leaf.vertices[0]] - Vec3(leaf.edge, 0, 0))
                .norm() < 1e-12);
        REQUIRE((l.points()[leaf.vertices[8]] - low_of(l, leaf) - Vec3::Constant(leaf.edge / 2))
                    .norm() < 1e-12);
        if (has_mixed_signs(leaf, values)) REQUIRE(leaf.edge <= 0.042 + 1e-12);
    }
    check_tets(l);
    CHECK(validate(adopted(l)).faults == std::vector<std::string>{});
}

TEST_CASE("a lattice made coarse keeps the leaves with both labels, the topology of any labels and "
          "its balance") {
    // Cells of all sizes beside each other, so that vertices hang on edges and faces of larger
    // cells.
    GradedLattice fine(with_cell(0.06), uneven_sizes(0.06, 60, 2), "test");
    std::mt19937 random(6);
    for (int round = 0; round < 3; ++round)
        fine.split_where([&](const Leaf&) { return random() % 8 == 0; });
    const auto tets = fine.tets();
    const Box3 box = fine.box();
    std::size_t merged = 0;
    for (int trial = 0; trial < 12; ++trial) {
        // A ball with holes of single vertices, and single vertices outside it; none where the
        // trial's share is 0.
        std::bernoulli_distribution other(trial % 4 * 0.01);
        std::vector<double> values;
        for (const Vec3& p : fine.points()) {
            const bool inside = (p.norm() < 0.3 + 0.06 * trial) != other(random);
            const bool on_box =
                ((p - box.low).array() <= 0).any() || ((p - box.high).array() >= 0).any();
            values.push_back(inside && !on_box ? 1.0 : -1.0);
        }
        std::vector<std::uint32_t> origins;
        const GradedLattice coarse = fine.coarsened(values, origins);
        REQUIRE(origins.size() == coarse.points().size());
        std::vector<double> kept;
        for (std::size_t v = 0; v < origins.size(); ++v) {
            REQUIRE(fine.points()[origins[v]] == coarse.points()[v]);
            kept.push_back(values[origins[v]]);
        }
        CHECK(count_topology(coarse.points(), coarse.tets(), kept) ==
              count_topology(fine.points(), tets, values));
        // of the coarse lattice's leaves, by their centres
        std::map<std::array<double, 3>, double> edges;
        for (const Leaf& leaf : coarse.leaves()) {
            const Vec3& centre = coarse.points()[leaf.vertices[8]];
            edges[{centre.x(), centre.y(), centre.z()}] = leaf.edge;
        }
        for (const Leaf& leaf : fine.leaves()) {
            const Vec3& centre = fine.points()[leaf.vertices[8]];
            if (has_mixed_signs(leaf, values))
                REQUIRE(edges[{centre.x(), centre.y(), centre.z()}] == leaf.edge);
        }
        merged += fine.leaves().size() - coarse.leaves().size();
        if (trial != 1) continue;
        check_tets(coarse);
        CHECK(validate(adopted(coarse)).faults == std::vector<std::string>{});
    }
    CHECK(merged > fine.leaves().size());
}

TEST_CASE("leaves of the smallest size stay when they are chosen") {
    GradedLattice l(with_cell(0.2), std::vector<CellSize>{{Vec3::Zero(), 0.0}}, "test");
    const std::size_t leaves = l.leaves().size(), points = l.points().size();
    CHECK(l.split_where([](const Leaf& leaf) { return leaf.edge < 0.21; }) == points);
    CHECK(l.leaves().size() == leaves);
    CHECK(l.split_where([](const Leaf&) { return true; }) == points);
    CHECK(l.leaves().size() > leaves);
}

TEST_CASE("4096 smallest cells along the box take memory only where they are") {
    const std::vector<CellSize> sizes = {{Vec3(0.2, 0.3, 0.4), 0.0}, {Vec3(-1.5, 1.5, 7), 1e-3}};
    const GradedLattice l(with_cell(3.0 / 4096), sizes, "test");
    CHECK(l.leaves().size() < 6000);
    CHECK(l.finest_cell() == doctest::Approx(3.0 / 4096));
    check_tets(l);
    CHECK(validate(adopted(l)).inverted_tets == 0);
}

TEST_CASE("the vertex near a place is the nearest one of its cell") {
    const GradedLattice l(with_cell(0.05), uneven_sizes(0.05, 50, 8), "test");
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-1.6, 1.6);
    for (int n = 0; n < 200; ++n) {
        const Vec3 place(uniform(random), uniform(random), uniform(random));
        const Vec3 within =
            place.cwiseMax(l.box().low * (1 - 1e-12)).cwiseMin(l.box().high * (1 - 1e-12));
        const auto leaf = std::find_if(l.leaves().begin(), l.leaves().end(), [&](const Leaf& x) {
            return overlaps(l, x, within, 0) ||
                   ((low_of(l, x).array() <= within.array()).all() &&
                    (low_of(l, x).array() + x.edge > within.array()).all());
        });
        REQUIRE(leaf != l.leaves().end());
        double least = 10;
        for (const std::uint32_t v : leaf->vertices)
            least = std::min(least, (l.points()[v] - place).norm());
        CHECK((l.points()[l.vertex_near(place)] - place).norm() == doctest::Approx(least));
    }
}

TEST_CASE("a lattice of too many cells along the box is refused") {
    try {
        const GradedLattice l(with_cell(3.0 / 5000), {}, "initial mesh 'x'");
        FAIL("not refused");
    } catch (const ConfigError& error) {
        CHECK(error.code() == "lattice.size");
        CHECK(std::string(error.what()).find("initial mesh 'x': the box contains 5000") == 0);
    }
    CHECK_THROWS_AS(GradedLattice(with_cell(1e-300), {}, "x"), ConfigError);
}
