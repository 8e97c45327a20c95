// Work side by side: the same bits for any number of threads, nothing done twice or left out, dates
// as one thread gives them.
#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/validate.hpp>

#include "kernel/operations.hpp"
#include "kernel/star_loop.hpp"
#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using mesh::TetId;
using mesh::VertexId;

namespace {

// 29^3 inner vertices: more than the loop needs to split its list.
mesh::Complex cells() { return mesh::adopt(test::ball_grid(30, 0.8), "ball"); }

std::vector<VertexId> inner_vertices(const mesh::Complex& c) {
    std::vector<VertexId> out;
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (c.vertex_alive(v) && !c.on_box(v)) out.push_back(v);
    }
    return out;
}

// Ten plates, two cells thick and two apart: a large interface in a small volume.
mesh::Complex plates() {
    constexpr int n = 42;
    return test::by_cells(
        [](int i, int j, int k) {
            return test::between(2, i, n - 3) && test::between(2, j, n - 3) &&
                           test::between(2, k, n - 3) && k % 4 >= 2
                       ? 1
                       : 0;
        },
        n);
}

// Shakes every vertex a little, each third one rests, and counts what the loop does.
struct Shake {
    enum class Note : std::uint8_t { rests, tried, moves };

    const mesh::Complex& complex;
    std::span<const VertexId> vertices;
    std::vector<std::uint8_t> attempts, settled;
    std::vector<std::uint32_t> dates;
    std::atomic<int>* busy;  // per tet: how many attempts hold it now
    std::atomic<int> collisions = 0;

    void prefetch(std::size_t, mesh::VertexId) const {}
    bool ready(std::size_t i, Note& note) const {
        note = i % 3 != 0 ? Note::tried : Note::rests;
        return i % 3 != 0;
    }
    bool attempt(std::size_t i, StarScratch& scratch, std::uint32_t, Note& note) {
        ++attempts[i];
        const auto& [star, neighbours] = scratch.star;
        for (const TetId t : star) {
            if (busy[t].fetch_add(1) != 0) ++collisions;
        }
        RandomStream random(RandomKey{7, 1, 0, complex.birth(vertices[i])});
        // Depends on the neighbours, so that the order in which they move shows in the bits.
        const Vec3 p = complex.position(vertices[i]);
        const Vec3 w = complex.position(neighbours[random.index(neighbours.size())]);
        scratch.place = p + 0.1 * (w - p);
        scratch.qualities.assign(star.size(), 0.5F);
        for (const TetId t : star) busy[t].fetch_sub(1);
        if (i % 5 != 0) note = Note::moves;
        return i % 5 != 0;
    }
    void settle(std::size_t i, std::uint32_t date, Note note) {
        CHECK(attempts[i] == (i % 3 != 0 ? 1 : 0));
        CHECK(note == (i % 3 == 0 ? Note::rests : i % 5 == 0 ? Note::tried : Note::moves));
        ++settled[i];
        dates[i] = date;
    }
};

struct Shaken {
    mesh::Complex complex;
    std::vector<std::uint32_t> dates;
    LargeVector<TetId> changes;
    std::vector<TetId> watched;  // sorted
};

// Flips that change who is whose neighbour, the same ones for equal complexes.
std::size_t edit(mesh::Complex& c, std::uint64_t pass) {
    Workbench bench(c);
    const double length = mesh::mean_interface_edge(c);
    bench.limits = {length, 1e-3, 0.5 * length, geometry::regular_tet_volume(length), 0.5};
    RandomStream random(RandomKey{9, pass, 0, 0});
    std::size_t committed = 0;
    for (int n = 0; n < 300; ++n) {
        repair::Request request;
        request.operation =
            n % 2 == 0 ? repair::Operation::edge_removal : repair::Operation::face_removal;
        request.tet = static_cast<TetId>(random.index(c.tet_slots()));
        if (!c.tet_alive(request.tet)) continue;
        request.birth_date = c.birth_date(request.tet);
        request.accept_above = 0.0F;
        committed += execute(bench, request).refused() ? 0 : 1;
    }
    return committed;
}

// `order` arranges the list.
template <class Order>
Shaken shake(Workers* workers, const Order& order) {
    Shaken out{cells(), {}, {}, {}};
    std::vector<VertexId> vertices = inner_vertices(out.complex);
    order(vertices);
    REQUIRE(vertices.size() >= StarLoop::least_split);
    out.complex.take_changes(out.changes);
    out.complex.start_watch();
    StarLoop loop(out.complex);
    for (std::uint64_t pass = 0; pass < 3; ++pass) {
        // A later pass knows from the earlier ones which vertices have no neighbour in another
        // block; edits between the passes make some of that wrong.
        if (pass > 0) CHECK(edit(out.complex, pass) > 20);
        out.complex.take_changes(out.changes);
        std::vector<std::atomic<int>> busy(out.complex.tet_slots());
        Shake action{out.complex,
                     vertices,
                     std::vector<std::uint8_t>(vertices.size(), 0),
                     std::vector<std::uint8_t>(vertices.size(), 0),
                     std::vector<std::uint32_t>(vertices.size(), 0),
                     busy.data()};
        const std::uint32_t clock = out.complex.clock();
        loop.run(vertices, workers, action);
        CHECK(action.collisions == 0);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            CHECK(action.attempts[i] == (i % 3 != 0 ? 1 : 0));
            CHECK(action.settled[i] == 1);
        }
        CHECK(out.complex.clock() == clock + vertices.size());
        out.dates = action.dates;
    }
    out.complex.take_changes(out.changes);
    const auto watched = out.complex.watched();
    out.watched.assign(watched.begin(), watched.end());
    std::sort(out.watched.begin(), out.watched.end());
    return out;
}

}  // namespace

TEST_CASE("star loop: every vertex once, no tet held by two, the bits and dates of one thread") {
    using List = std::vector<VertexId>;
    const auto as_it_is = [](List&) {};
    const auto shuffled = [](List& list) {
        RandomStream random(RandomKey{5, 1, 0, 0});
        for (std::size_t i = list.size(); i > 1; --i) std::swap(list[i - 1], list[random.index(i)]);
    };
    const auto short_list = [](List& list) { list.resize(StarLoop::least_split); };
    const auto check = [](const auto& order) {
        const Shaken one = shake(nullptr, order);
        // A vertex' date is that of the last move in its neighbourhood, and what moved is on the
        // change list once.
        LargeVector<TetId> sorted = one.changes;
        std::sort(sorted.begin(), sorted.end());
        CHECK(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end());
        std::vector<TetId> star;
        for (const VertexId v : inner_vertices(one.complex)) {
            one.complex.star(v, star);
            std::uint32_t latest = 0;
            for (const TetId t : star) latest = std::max(latest, one.complex.date(t));
            REQUIRE(one.complex.vertex_date(v) == latest);
        }
        for (const unsigned threads : {2U, 4U}) {
            CAPTURE(threads);
            Workers workers(threads);
            const Shaken other = shake(&workers, order);
            CHECK(other.dates == one.dates);
            CHECK(other.changes == one.changes);
            CHECK(other.watched == one.watched);
            for (VertexId v = 0; v < one.complex.vertex_slots(); ++v) {
                REQUIRE((one.complex.position(v) == other.complex.position(v)));
                REQUIRE(one.complex.vertex_date(v) == other.complex.vertex_date(v));
            }
        }
        return sorted.size() > one.complex.tet_count() / 2;
    };
    SUBCASE("in order of birth") { CHECK(check(as_it_is)); }
    SUBCASE("shuffled") { CHECK(check(shuffled)); }
    SUBCASE("the shortest list that is divided") { check(short_list); }
}

namespace {

struct Throws {
    enum class Note : std::uint8_t { nothing };

    std::size_t at;
    std::vector<int> settled;
    void prefetch(std::size_t, mesh::VertexId) const {}
    bool ready(std::size_t i, Note&) const {
        if (i == at) throw std::runtime_error("at its turn");
        return false;
    }
    bool attempt(std::size_t, StarScratch&, std::uint32_t, Note&) const { return false; }
    void settle(std::size_t i, std::uint32_t, Note) { ++settled[i]; }
};

// Whether a vertex is tried depends on its date, as with remembered refusals.
struct AfterNeighbours {
    enum class Note : std::uint8_t { nothing };

    const mesh::Complex& complex;
    std::span<const VertexId> vertices;
    std::vector<std::uint32_t> known;  // per vertex: the clock at its last turn
    std::vector<std::uint8_t> tried;

    void prefetch(std::size_t, mesh::VertexId) const {}
    bool ready(std::size_t i, Note&) const {
        return i % 7 == 0 || complex.vertex_date(vertices[i]) > known[vertices[i]];
    }
    bool attempt(std::size_t i, StarScratch& scratch, std::uint32_t, Note&) {
        ++tried[i];
        scratch.place = 0.9 * complex.position(vertices[i]) +
                        0.1 * complex.position(scratch.star.neighbours.front());
        scratch.qualities.assign(scratch.star.tets.size(), 0.5F);
        return i % 4 == 3;
    }
    void settle(std::size_t i, std::uint32_t date, Note) { known[vertices[i]] = date; }
};

std::pair<std::vector<std::uint8_t>, std::vector<std::uint32_t>> after_neighbours(Workers* workers,
                                                                                  bool twice) {
    mesh::Complex c = cells();
    std::vector<VertexId> vertices = inner_vertices(c);
    if (twice) vertices.insert(vertices.end(), vertices.begin(), vertices.begin() + 1000);
    AfterNeighbours action{c, vertices, std::vector<std::uint32_t>(c.vertex_slots(), c.clock()),
                           std::vector<std::uint8_t>(vertices.size(), 0)};
    StarLoop loop(c);
    for (int pass = 0; pass < 3; ++pass) loop.run(vertices, workers, action);
    std::vector<std::uint32_t> dates;
    for (const VertexId v : vertices) dates.push_back(c.vertex_date(v));
    return {action.tried, dates};
}

}  // namespace

TEST_CASE("star loop: a vertex sees the dates of its neighbours' moves as with one thread, also in "
          "a list that has vertices twice") {
    for (const bool twice : {false, true}) {
        CAPTURE(twice);
        const auto one = after_neighbours(nullptr, twice);
        const auto tried = static_cast<std::size_t>(
            std::count_if(one.first.begin(), one.first.end(), [](int n) { return n > 0; }));
        CHECK(tried > one.first.size() / 4);
        CHECK(std::count(one.first.begin(), one.first.end(), 3) <
              static_cast<std::ptrdiff_t>(one.first.size()));
        for (const unsigned threads : {2U, 5U}) {
            Workers workers(threads);
            const auto other = after_neighbours(&workers, twice);
            CHECK(other.first == one.first);
            CHECK(other.second == one.second);
        }
    }
}

TEST_CASE(
    "star loop: a vertex sees its neighbours' moves also after the blocks have been made anew "
    "for a list in another part of space") {
    const auto run = [](Workers* workers) {
        mesh::Complex c = cells();
        const std::vector<VertexId> all = inner_vertices(c);
        // A corner of the box, which is only a small part of the blocks of the whole list.
        std::vector<VertexId> corner;
        const Vec3 centre = c.box().centre();
        for (const VertexId v : all) {
            if ((c.position(v).array() < centre.array()).all()) corner.push_back(v);
        }
        RandomStream random(RandomKey{11, 1, 0, 0});
        for (std::size_t i = corner.size(); i > 1; --i)
            std::swap(corner[i - 1], corner[random.index(i)]);
        StarLoop loop(c);
        std::vector<std::uint32_t> dates;
        std::vector<std::uint8_t> tried;
        for (const std::vector<VertexId>* list : {&all, &all, &std::as_const(corner)}) {
            AfterNeighbours action{c, *list,
                                   std::vector<std::uint32_t>(c.vertex_slots(), c.clock()),
                                   std::vector<std::uint8_t>(list->size(), 0)};
            loop.run(*list, workers, action);
            tried.insert(tried.end(), action.tried.begin(), action.tried.end());
        }
        for (const VertexId v : all) dates.push_back(c.vertex_date(v));
        return std::pair(tried, dates);
    };
    const auto one = run(nullptr);
    for (int again = 0; again < 5; ++again) {
        Workers workers(4);
        const auto other = run(&workers);
        CHECK(other.first == one.first);
        CHECK(other.second == one.second);
    }
}

TEST_CASE("star loop: an exception of one vertex ends the loop, and the next loop works") {
    mesh::Complex c = cells();
    const std::vector<VertexId> vertices = inner_vertices(c);
    Workers workers(3);
    StarLoop loop(c);
    Throws bad{vertices.size() / 2, std::vector<int>(vertices.size(), 0)};
    CHECK_THROWS_WITH(loop.run(vertices, &workers, bad), "at its turn");
    Throws good{vertices.size(), std::vector<int>(vertices.size(), 0)};
    loop.run(vertices, &workers, good);
    CHECK(std::count(good.settled.begin(), good.settled.end(), 1) ==
          static_cast<std::ptrdiff_t>(vertices.size()));
}

TEST_CASE(
    "deformer: steps over blocks give the same bits for 1, 2 and 3 threads, and a valid complex") {
    const auto run = [](Workers* workers) {
        DeformerOptions options;
        options.audit = true;
        Deformer d(plates(), options, workers);
        CHECK(d.complex().interface_vertices().size() >= StarLoop::least_split);
        const double length = d.target_length();
        StepReport last;
        for (int step = 0; step < 3; ++step) {
            std::vector<VertexId> vertices(d.complex().interface_vertices().begin(),
                                           d.complex().interface_vertices().end());
            std::sort(vertices.begin(), vertices.end(), [&d](VertexId a, VertexId b) {
                return d.complex().birth(a) < d.complex().birth(b);
            });
            std::vector<Vec3> displacements;
            for (const VertexId v : vertices) {
                RandomStream random(
                    RandomKey{3, 1, static_cast<std::uint64_t>(step), d.complex().birth(v)});
                displacements.emplace_back(0.3 * length * random.normal(),
                                           0.3 * length * random.normal(),
                                           0.3 * length * random.normal());
            }
            last = d.step(vertices, displacements, test::smoothing_policy());
        }
        return std::pair(d.complex().to_mesh(), last);
    };
    const auto [one, report] = run(nullptr);
    // The lists were long enough to be split.
    CHECK(report.operations[static_cast<std::size_t>(repair::Operation::smooth_laplacian)].tried >=
          StarLoop::least_split);
    CHECK(mesh::validate(mesh::adopt(one, "result")).valid());
    for (const unsigned threads : {2U, 3U}) {
        CAPTURE(threads);
        Workers workers(threads);
        const auto [other, other_report] = run(&workers);
        CHECK(other.points == one.points);
        CHECK(other.tets == one.tets);
        CHECK(other.labels == one.labels);
        CHECK(other_report.dropped_motion == report.dropped_motion);
    }
}
