#include "edits.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using namespace dsc::remesh;

// A view and its edges, with the same lifetime.
struct Start {
    explicit Start(const dsc::surface::TriangleMesh& triangles)
        : view(dsc::sdk::view_of(triangles)) {
        mesh.build(view);
        edits.start_refinement();
        edits.start_pass(mesh);
    }
    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;
    double length(std::uint32_t a, std::uint32_t b) const {
        return (view.positions[a] - view.positions[b]).norm();
    }

    dsc::surface::SurfaceView view;
    EdgeMesh mesh;
    Edits edits;
};

dsc::surface::TriangleMesh shaken(dsc::surface::TriangleMesh mesh, double most,
                                  std::uint64_t seed) {
    dsc::RandomStream random(dsc::RandomKey{seed, 0, 0, 0});
    return dsc::sdk::moved(std::move(mesh), [&](const Vec3& p) {
        return Vec3(
            p + most * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    });
}

// Two half planes that meet at x = 0 at a right angle.
dsc::surface::TriangleMesh roof(unsigned n) {
    return dsc::sdk::moved(dsc::sdk::square(n, 1.0),
                           [](const Vec3& p) { return Vec3(p.x(), p.y(), -std::abs(p.x())); });
}

bool ridge(const Vec3& p) { return std::abs(p.x()) < 1e-12; }

}  // namespace

TEST_CASE("edges above 4/3 of the target length are split, the longest first, and no others") {
    Start s(shaken(dsc::sdk::icosphere(3, 1.0), 0.05, 3));
    const Lengths lengths{0.12};
    std::vector<std::array<std::uint32_t, 2>> splits;
    s.edits.split(s.mesh, lengths, splits);
    REQUIRE(splits.size() > 100);
    for (std::size_t i = 1; i < splits.size(); ++i)
        CHECK(s.length(splits[i - 1][0], splits[i - 1][1]) >= s.length(splits[i][0], splits[i][1]));
    std::size_t wanted = 0;
    for (const double length : s.mesh.lengths) wanted += length > 0.16 ? 1 : 0;
    CHECK(splits.size() == wanted);
    // A length per vertex: only edges at vertices with short lengths are split.
    std::vector<double> each(s.view.vertex_count(), 1.0);
    each[7] = 0.01;
    splits.clear();
    s.edits.split(s.mesh, {0.0, each}, splits);
    CHECK(splits.empty());  // half of the sum of 1 and 0.01 is longer than all edges
    for (const std::uint32_t f : s.view.faces_of(7)) {
        for (const std::uint32_t v : s.view.faces[f]) each[v] = 0.01;
    }
    s.edits.split(s.mesh, {0.0, each}, splits);
    CHECK(splits.size() == 2 * s.view.faces_of(7).size());
}

TEST_CASE("short edges collapse to their midpoints, independently, and make no long edge and no "
          "sharp turn") {
    Start s(shaken(dsc::sdk::icosphere(4, 1.0), 0.004, 5));
    const Lengths lengths{0.12};
    std::vector<dsc::hooks::CollapseRequest> collapses;
    s.edits.collapse(s.mesh, lengths, false, collapses);
    REQUIRE(collapses.size() > s.view.vertex_count() / 12);
    std::vector<int> taken(s.view.vertex_count(), 0);
    std::size_t in_the_middle = 0;
    for (const auto& r : collapses) {
        CHECK(s.length(r.kept, r.removed) < 0.8 * 0.12);
        const Vec3 middle = 0.5 * (s.view.positions[r.kept] + s.view.positions[r.removed]);
        in_the_middle += (r.place - middle).norm() < 1e-15 ? 1 : 0;
        CHECK(std::min({(r.place - middle).norm(), (r.place - s.view.positions[r.kept]).norm(),
                        (r.place - s.view.positions[r.removed]).norm()}) < 1e-15);
        // No end is next to another collapse.
        CHECK(taken[r.kept] == 0);
        CHECK(taken[r.removed] == 0);
        for (const std::uint32_t end : {r.kept, r.removed}) {
            for (const std::uint32_t f : s.view.faces_of(end)) {
                for (const std::uint32_t v : s.view.faces[f]) {
                    taken[v] = 1;
                    if (v != r.kept && v != r.removed)
                        CHECK((s.view.positions[v] - r.place).norm() <= 4.0 / 3.0 * 0.12);
                }
            }
        }
    }
    CHECK(in_the_middle > 0.9 * static_cast<double>(collapses.size()));
    // If every new edge would be too long, nothing is collapsed; the border of an open mesh is not
    // collapsed either.
    Start plane(dsc::sdk::square(8, 1.0));
    collapses.clear();
    plane.edits.collapse(plane.mesh, {0.26 / 0.8}, false, collapses);
    for (const auto& r : collapses) {
        CHECK(plane.view.positions[r.kept].cwiseAbs().maxCoeff() < 0.99);
        CHECK(plane.view.positions[r.removed].cwiseAbs().maxCoeff() < 0.99);
    }
}

TEST_CASE("a refused collapse is requested again with the ends as places, then no more") {
    Start s(shaken(dsc::sdk::icosphere(2, 1.0), 0.02, 9));
    const Lengths lengths{0.42};
    std::vector<std::vector<dsc::hooks::CollapseRequest>> asked;
    do {
        s.edits.start_pass(s.mesh);
        asked.emplace_back();
        s.edits.collapse(s.mesh, lengths, false, asked.back());
        REQUIRE(asked.size() < 100);
    } while (!asked.back().empty());
    std::vector<std::array<Vec3, 3>> seen;
    for (const auto& pass : asked) {
        for (const auto& r : pass) {
            const Vec3 &a = s.view.positions[std::min(r.kept, r.removed)],
                       &b = s.view.positions[std::max(r.kept, r.removed)];
            seen.push_back({a, b, r.place});
        }
    }
    const auto less = [](const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& y) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (int k = 0; k < 3; ++k) {
                if (x[i][k] != y[i][k]) return x[i][k] < y[i][k];
            }
        }
        return false;
    };
    std::sort(seen.begin(), seen.end(), less);
    CHECK(std::adjacent_find(seen.begin(), seen.end()) == seen.end());  // no request is repeated
    std::size_t at_ends = 0;
    for (const auto& [a, b, place] : seen) at_ends += place == a || place == b ? 1 : 0;
    CHECK(at_ends > 20);
}

TEST_CASE("a crease becomes shorter only along itself") {
    Start s(shaken(roof(16), 0.0, 1));
    const Lengths lengths{0.3};
    for (const bool keep : {false, true}) {
        s.edits.start_refinement();
        std::vector<dsc::hooks::CollapseRequest> all;
        for (int pass = 0; pass < 12; ++pass) {
            s.edits.start_pass(s.mesh);
            s.edits.collapse(s.mesh, lengths, keep, all);
        }
        REQUIRE(all.size() > 20);
        std::size_t along = 0, beside = 0;
        for (const auto& r : all) {
            const bool kept = ridge(s.view.positions[r.kept]),
                       removed = ridge(s.view.positions[r.removed]);
            if (kept || removed) CHECK(ridge(r.place));
            along += kept && removed ? 1 : 0;
            beside += kept != removed ? 1 : 0;
            CHECK((kept || !removed));
        }
        CHECK(along > 0);
        CHECK(beside > 0);
    }
}

TEST_CASE("flips make a plane's triangulation Delaunay, and leave creases") {
    // Columns that are shifted against each other: many diagonals have opposite angles above pi.
    const auto slanted = dsc::sdk::moved(dsc::sdk::square(10, 1.0), [](const Vec3& p) {
        return Vec3(p.x(), p.y() + 0.8 * p.x(), 0.0);
    });
    Start s(slanted);
    std::vector<dsc::hooks::FlipRequest> flips;
    s.edits.flip(s.mesh, -1.0, flips);
    REQUIRE(flips.size() > 50);
    std::vector<int> used(s.view.face_count(), 0);
    for (const auto& r : flips) {
        CHECK(r.flatness == -1.0);
        for (std::size_t e = 0; e < s.mesh.edges.size(); ++e) {
            if (s.mesh.edges[e].vertices != r.edge) continue;
            const Vec3 &a = s.view.positions[r.edge[0]], &b = s.view.positions[r.edge[1]];
            double sum = 0.0;
            for (const unsigned side : {0U, 1U}) {
                const Vec3& p = s.view.positions[s.mesh.opposite(e, side)];
                sum += std::acos((a - p).normalized().dot((b - p).normalized()));
                CHECK(++used[s.mesh.edges[e].faces[side]] == 1);
            }
            CHECK(sum > 3.14159265358979);
        }
    }
    // Both diagonals of a square are allowed to stay.
    Start square(dsc::sdk::square(10, 1.0));
    flips.clear();
    square.edits.flip(square.mesh, -1.0, flips);
    CHECK(flips.empty());
    // A ridge between needles on both sides: a flip would improve it, but is not allowed.
    Start crease(dsc::sdk::moved(
        roof(10), [](const Vec3& p) { return Vec3(0.2 * p.x(), p.y(), 0.2 * p.z()); }));
    flips.clear();
    crease.edits.flip(crease.mesh, -1.0, flips);
    const auto on_ridge = [&](const auto& r) {
        return ridge(crease.view.positions[r.edge[0]]) && ridge(crease.view.positions[r.edge[1]]);
    };
    const auto free = std::count_if(flips.begin(), flips.end(), on_ridge);
    flips.clear();
    crease.edits.start_refinement();
    crease.edits.start_pass(crease.mesh);
    crease.edits.flip(crease.mesh, std::cos(0.6), flips);
    CHECK(std::count_if(flips.begin(), flips.end(), on_ridge) == 0);
    CHECK(free >= 0);
}

TEST_CASE("vertices move along the surface, half the way, and not off creases") {
    Start s(shaken(roof(12), 0.0, 1));
    // Move the vertices of one side within their plane.
    dsc::RandomStream random(dsc::RandomKey{4, 0, 0, 0});
    auto pulled = dsc::sdk::moved(roof(12), [&](const Vec3& p) {
        if (std::abs(p.x()) < 0.1 || p.cwiseAbs().maxCoeff() > 0.99) return p;
        const double side = p.x() > 0 ? 1.0 : -1.0;
        return Vec3(p + 0.05 * random.uniform(-1, 1) * Vec3(1, 0, -side) +
                    0.05 * random.uniform(-1, 1) * Vec3(0, 1, 0));
    });
    Start p(pulled);
    std::vector<dsc::hooks::MoveRequest> moves;
    p.edits.move(p.mesh, {0.16}, moves);
    REQUIRE(moves.size() > 60);
    for (const auto& r : moves) {
        CHECK_FALSE(ridge(p.view.positions[r.vertex]));
        CHECK(std::abs(r.place.z() + std::abs(r.place.x())) < 1e-12);
        Vec3 sum = Vec3::Zero();
        double area = 0.0;
        for (const std::uint32_t f : p.view.faces_of(r.vertex)) {
            const auto& [a, b, c] = p.view.faces[f];
            sum += p.view.face_areas[f] *
                   (p.view.positions[a] + p.view.positions[b] + p.view.positions[c]) / 3.0;
            area += p.view.face_areas[f];
        }
        CHECK((r.place - 0.5 * (p.view.positions[r.vertex] + sum / area)).norm() < 1e-12);
    }
}
