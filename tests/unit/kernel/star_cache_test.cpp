// What the complex stores round a vertex is what a walk finds, after any sequence of operations.
#include <algorithm>
#include <atomic>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/adopt.hpp>

#include "kernel/movement.hpp"
#include "kernel/operations.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using repair::Operation;

namespace {

repair::Request random_request(const mesh::Complex& c, RandomStream& random) {
    repair::Request request;
    request.operation = static_cast<Operation>(random.index(repair::operation_count));
    request.tet = c.seed(c.interface_vertices()[random.index(c.interface_vertices().size())]);
    request.birth_date = c.birth_date(request.tet);
    request.mode = repair::CollapseMode::bounded;
    request.accept_above = 0.0F;
    const auto& v = c.tet(request.tet).v;
    const auto& e = mesh::edge_vertices[random.index(6)];
    if (request.operation <= Operation::smooth_optimise) request.vertices[0] = v[e[0]];
    if (request.operation == Operation::vertex_split)
        request.vertices = {v[e[0]], v[e[1]], mesh::none};
    return request;
}

// The tets of each vertex with their labels, by a scan over all tets.
using Stars = std::vector<std::vector<std::array<std::uint32_t, 3>>>;
Stars scan(const mesh::Complex& c) {
    Stars stars(c.vertex_slots());
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t)) continue;
        for (const VertexId v : c.tet(t).v)
            stars[v].push_back({t, c.birth_date(t), static_cast<std::uint32_t>(c.label(t))});
    }
    return stars;
}

// The cached stars and neighbours have the tets of the scan, in the order of a walk without cache.
void check_cache(const mesh::Complex& c, const Stars& stars) {
    const mesh::Complex walked = c;  // a copy has no stored stars
    mesh::StarWalk walk;
    mesh::TetIndex places;
    std::vector<TetId> star, expected, sorted;
    std::vector<VertexId> neighbours, others;
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (!c.vertex_alive(v)) continue;
        walked.star(v, expected, places);
        for (int again = 0; again < 2; ++again) {
            const mesh::Star all = c.cached_star(v, walk);
            star.assign(all.tets.begin(), all.tets.end());
            neighbours.assign(all.neighbours.begin(), all.neighbours.end());
            REQUIRE(star == expected);
        }
        REQUIRE(star.front() == c.seed(v));
        sorted = star;
        std::sort(sorted.begin(), sorted.end());
        REQUIRE(sorted.size() == stars[v].size());
        others.clear();
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            REQUIRE(sorted[i] == stars[v][i][0]);
            for (const VertexId w : c.tet(sorted[i]).v) {
                if (w != v && std::find(others.begin(), others.end(), w) == others.end())
                    others.push_back(w);
            }
        }
        std::sort(others.begin(), others.end(),
                  [&c](VertexId a, VertexId b) { return c.birth(a) < c.birth(b); });
        REQUIRE(neighbours == others);
    }
}

}  // namespace

TEST_CASE("stored stars, neighbours and shape dates follow every operation") {
    std::size_t committed = 0, moved = 0, changed = 0, kept = 0;
    for (const test::LabelledMesh& labelled : test::labelled_meshes()) {
        CAPTURE(labelled.name);
        mesh::Complex c = labelled.complex;
        RandomStream random(RandomKey{11, 0, 0, 0});
        Workbench bench(c);
        const double length = mesh::mean_interface_edge(c);
        bench.limits = {length, 1e-3, 0.5 * length, geometry::regular_tet_volume(length), 0.5};
        Stars before = scan(c);
        std::vector<VertexId> reshaped;
        c.take_reshaped(reshaped);  // adoption may have relabelled tets
        std::uint32_t clock = c.clock();
        for (int n = 0; n < 3000; ++n) {
            if (n % 3 == 0) {
                const VertexId v =
                    c.interface_vertices()[random.index(c.interface_vertices().size())];
                const Vec3 way(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
                if (c.movable(v) &&
                    move_towards(bench, v, c.position(v) + length * way, 0.9) != Motion::blocked)
                    ++moved;
            } else {
                committed += execute(bench, random_request(c, random)).refused() ? 0 : 1;
            }
            if (n % 40 != 39) continue;
            const Stars now = scan(c);
            check_cache(c, now);
            c.take_reshaped(reshaped);
            std::sort(reshaped.begin(), reshaped.end());
            REQUIRE(std::adjacent_find(reshaped.begin(), reshaped.end()) == reshaped.end());
            for (VertexId v = 0; v < c.vertex_slots(); ++v) {
                if (!c.vertex_alive(v)) continue;
                const bool same = v < before.size() && before[v] == now[v];
                if (!same) REQUIRE(c.shape_date(v) > clock);
                (c.shape_date(v) > clock ? changed : kept) += 1;
                REQUIRE(std::binary_search(reshaped.begin(), reshaped.end(), v) ==
                        (c.shape_date(v) > clock));
            }
            before = now;
            clock = c.clock();
        }
    }
    CHECK(committed > 500);
    CHECK(moved > 500);
    CHECK(changed > 500);
    CHECK(kept > 5 * changed);
}

TEST_CASE("threads that ask for the same stars at the same time get those of a walk") {
    std::atomic<std::size_t> compared{0}, different{0};
    Workers workers(4);
    for (const test::LabelledMesh& labelled : test::labelled_meshes()) {
        const mesh::Complex walked = labelled.complex;
        const Stars stars = scan(walked);
        for (int repeat = 0; repeat < 5; ++repeat) {
            const mesh::Complex c = labelled.complex;  // a copy has no stored stars
            // Each vertex is asked for four times in a row, by different threads.
            workers.for_blocks(4 * c.vertex_slots(), 1, [&](std::size_t begin, std::size_t) {
                const auto v = static_cast<VertexId>(begin / 4);
                if (!c.vertex_alive(v)) return;
                thread_local mesh::StarWalk walk, own_walk;
                thread_local mesh::TetIndex places;
                thread_local std::vector<TetId> expected;
                const mesh::Star star = c.cached_star(v, walk);
                if (repeat == 0) {
                    walked.star(v, expected, places);
                    different += expected.size() == stars[v].size() ? 0U : 1U;
                } else {
                    const mesh::Star again = c.cached_star(v, own_walk);
                    expected.assign(again.tets.begin(), again.tets.end());
                }
                const bool same = std::equal(star.tets.begin(), star.tets.end(), expected.begin(),
                                             expected.end());
                different += same ? 0U : 1U;
                ++compared;
            });
            check_cache(c, stars);
        }
    }
    CHECK(compared > 10000);
    CHECK(different == 0);
}

TEST_CASE("the watched tets are those that have changed since the start, each once, whatever was "
          "taken meanwhile") {
    std::size_t found = 0, rest = 0;
    for (const test::LabelledMesh& labelled : test::labelled_meshes()) {
        CAPTURE(labelled.name);
        mesh::Complex c = labelled.complex;
        CHECK(c.watched().empty());
        RandomStream random(RandomKey{12, 0, 0, 0});
        Workbench bench(c);
        const double length = mesh::mean_interface_edge(c);
        bench.limits = {length, 1e-3, 0.5 * length, geometry::regular_tet_volume(length), 0.5};
        LargeVector<TetId> taken;
        std::vector<TetId> watched;
        for (int start = 0; start < 20; ++start) {
            // What has not been taken yet is watched from the start.
            const std::vector<TetId> open(c.changes().begin(), c.changes().end());
            c.start_watch();
            const std::uint32_t clock = c.clock();
            for (int n = 0; n < 40; ++n) {
                if (random.index(8) == 0) c.take_changes(taken);
                static_cast<void>(execute(bench, random_request(c, random)));
            }
            watched.assign(c.watched().begin(), c.watched().end());
            std::sort(watched.begin(), watched.end());
            REQUIRE(std::adjacent_find(watched.begin(), watched.end()) == watched.end());
            for (TetId t = 0; t < c.tet_slots(); ++t) {
                if (!c.tet_alive(t)) continue;
                const bool changed =
                    c.date(t) > clock || std::find(open.begin(), open.end(), t) != open.end();
                REQUIRE(std::binary_search(watched.begin(), watched.end(), t) == changed);
                (changed ? found : rest) += 1;
            }
            // A tet that has not changed can be added.
            const auto still = c.tet(c.seed(c.interface_vertices().front())).v[0];
            const TetId t = c.seed(still);
            const bool known = std::binary_search(watched.begin(), watched.end(), t);
            c.watch(std::span(&t, 1));
            CHECK(c.watched().size() == watched.size() + (known ? 0 : 1));
        }
    }
    CHECK(found > 1000);
    CHECK(rest > 1000);
}

TEST_CASE("a ring inside a phase is the whole ring, or it is refused for a reason") {
    for (const test::LabelledMesh& labelled : test::labelled_meshes()) {
        const mesh::Complex& c = labelled.complex;
        mesh::EdgeRing whole, inner;
        std::size_t found = 0, refused = 0;
        for (TetId t = 0; t < c.tet_slots(); ++t) {
            if (!c.tet_alive(t)) continue;
            for (const auto& e : mesh::edge_vertices) {
                const VertexId a = c.tet(t).v[e[0]], b = c.tet(t).v[e[1]];
                if (c.on_box(a) && c.on_box(b)) continue;
                c.ring(t, a, b, whole);
                const bool one_label =
                    std::all_of(whole.tets.begin(), whole.tets.end(),
                                [&](TetId r) { return c.label(r) == c.label(t); });
                const bool fits = one_label && whole.tets.size() <= 5;
                REQUIRE(c.inner_ring(t, a, b, 5, inner) == fits);
                (fits ? found : refused) += 1;
                if (!fits) continue;
                REQUIRE(inner.closed);
                REQUIRE(inner.tets == whole.tets);
                REQUIRE(inner.link == whole.link);
            }
        }
        CHECK(found > 0);
        CHECK(refused > 0);
    }
}
