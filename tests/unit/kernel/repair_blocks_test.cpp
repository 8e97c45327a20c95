// Repair in blocks of space: long random lists of requests give the same bytes for any number of
// threads, the same mesh as one request after the other in the reported order, and keep every
// invariant.
#include "kernel/repair_blocks.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/base/state.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/validate.hpp>

#include "policy.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using repair::Operation;

namespace {

// A complex with all that follows its edits, as a Deformer has it.
struct Rig {
    mesh::Complex complex;
    Workbench bench{complex};
    RepairQueues queues{complex, false, 0};
    StarLoop loop{complex};
    Destinations destinations{complex, queues, loop};
    VertexFields fields{complex, destinations};
    RepairBlocks blocks{bench, fields, destinations};

    explicit Rig(mesh::Complex start) : complex(std::move(start)) {
        const double length = mesh::mean_interface_edge(complex);
        bench.limits = {length, 1e-3, 0.5 * length, geometry::regular_tet_volume(length), 0.5};
        bench.limits.set_floor(1e-3);
        bench.listener = &fields;
    }
};

std::string bytes_of(const mesh::Complex& c) {
    StateWriter out;
    c.save(out);
    return out.take();
}

// Five labelled forms in grids of 20^3 cells.
std::vector<test::LabelledMesh> start_meshes() {
    constexpr int n = 20;
    using test::between;
    std::vector<test::LabelledMesh> out;
    const auto inside = [](int i, int j, int k) {
        return between(3, i, n - 4) && between(3, j, n - 4) && between(3, k, n - 4);
    };
    out.push_back(
        {"block", test::by_cells([&](int i, int j, int k) { return inside(i, j, k) ? 1 : 0; }, n)});
    out.push_back(
        {"plates",
         test::by_cells([&](int i, int j, int k) { return inside(i, j, k) && k % 4 >= 2 ? 1 : 0; },
                        n)});
    out.push_back({"two phases", test::by_cells(
                                     [&](int i, int j, int k) {
                                         return !inside(i, j, k) ? 0 : i < n / 2 ? 1 : 2;
                                     },
                                     n)});
    out.push_back({"columns", test::by_cells(
                                  [&](int i, int j, int k) {
                                      return inside(i, j, k) && i % 4 >= 2 && j % 4 >= 2 ? 1 : 0;
                                  },
                                  n)});
    out.push_back({"ball", mesh::adopt(test::ball_grid(n, 0.8), "ball")});
    return out;
}

// Moves all inner vertices at random, so that there is something to repair.
void shake(mesh::Complex& c, std::uint64_t seed) {
    std::vector<TetId> star;
    const double way = 0.15 * mesh::mean_interface_edge(c);
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (c.on_box(v)) continue;
        RandomStream random(RandomKey{seed, 5, 0, c.birth(v)});
        const Vec3 place =
            c.position(v) + way * Vec3(random.normal(), random.normal(), random.normal());
        c.star(v, star);
        const bool positive = std::all_of(star.begin(), star.end(), [&](TetId t) {
            std::array<Vec3, 4> p;
            for (unsigned i = 0; i < 4; ++i)
                p[i] = c.tet(t).v[i] == v ? place : c.position(c.tet(t).v[i]);
            return geometry::tet_quality(p[0], p[1], p[2], p[3]) > 0.02;
        });
        if (positive) c.move(v, place, star);
    }
}

// Mixed requests of all operations, on random tets; about half of them name a simplex. `nameless`:
// some name no tet. Those depend on the slots of their vertices, which may have new owners.
std::vector<repair::Request> random_requests(const mesh::Complex& c, std::uint64_t seed,
                                             std::size_t count, bool nameless) {
    RandomStream random(RandomKey{seed, 6, 0, 0});
    std::vector<repair::Request> out;
    while (out.size() < count) {
        TetId t = static_cast<TetId>(random.index(c.tet_slots()));
        if (random.index(3) != 0)
            t = c.seed(c.interface_vertices()[random.index(c.interface_vertices().size())]);
        if (!c.tet_alive(t)) continue;
        repair::Request r =
            repair::on_tet(c, t, static_cast<Operation>(random.index(repair::operation_count)));
        r.mode = random.index(2) == 0 ? repair::CollapseMode::safe : repair::CollapseMode::bounded;
        r.accept_above = random.index(3) == 0 ? 2.0F : 0.01F;
        r.parameter = static_cast<float>(random.uniform(0.1, 0.9));
        const auto& ends = mesh::edge_vertices[random.index(6)];
        const VertexId a = c.tet(t).v[ends[0]], b = c.tet(t).v[ends[1]];
        switch (r.operation) {
            case Operation::smooth_laplacian:
            case Operation::smooth_optimise: r.vertices[0] = a; break;
            case Operation::vertex_split: r.vertices = {a, b, mesh::none}; break;
            case Operation::compound:
            case Operation::relabel:
            case Operation::face_removal:
            case Operation::face_split: break;
            default:
                if (random.index(2) == 0) r.vertices = {a, b, mesh::none};
        }
        if (nameless && random.index(50) == 0 && r.vertices[1] != mesh::none) r.tet = mesh::none;
        if (random.index(50) == 0) --r.birth_date;  // of a tet that does not exist any more
        out.push_back(r);
    }
    return out;
}

struct Executed {
    std::uint32_t request;
    Outcome outcome;
};

std::vector<Executed> run(Rig& rig, std::span<const repair::Request> requests, Workers* workers) {
    std::vector<Executed> out;
    rig.blocks.run(requests, workers, [&](std::uint32_t i, Outcome outcome, std::uint32_t) {
        out.push_back({i, outcome});
    });
    return out;
}

// The requests at the end of the report that ascend: at most those that ran in no block, and a few
// of the last block.
std::size_t serial_rest(const std::vector<Executed>& done) {
    std::size_t first = done.size() - 1;
    while (first > 0 && done[first - 1].request < done[first].request) --first;
    return done.size() - first;
}

// What must hold after each list, whatever was done.
void check_complex(const mesh::Complex& c) {
    REQUIRE(mesh::validate(c).faults == std::vector<std::string>{});
    // Births are unique and below the next one.
    std::vector<std::uint32_t> births;
    std::vector<VertexId> listed(c.interface_vertices().begin(), c.interface_vertices().end()),
        expected;
    std::vector<TetId> star;
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if (!c.vertex_alive(v)) continue;
        births.push_back(c.birth(v));
        c.star(v, star);
        const bool several = std::any_of(
            star.begin(), star.end(), [&](TetId t) { return c.label(t) != c.label(star.front()); });
        if (several || (c.on_box(v) && c.label(star.front()) != 0)) expected.push_back(v);
        std::uint32_t latest = 0;
        for (const TetId t : star) latest = std::max(latest, c.date(t));
        REQUIRE(c.vertex_date(v) >= latest);
        REQUIRE(c.vertex_date(v) <= c.clock());
    }
    std::sort(births.begin(), births.end());
    REQUIRE(std::adjacent_find(births.begin(), births.end()) == births.end());
    REQUIRE(births.back() < c.next_birth());
    std::sort(listed.begin(), listed.end());
    REQUIRE(listed == expected);
}

bool same_mesh(const mesh::Complex& x, const mesh::Complex& y) {
    const mesh::TetMesh a = x.to_mesh(), b = y.to_mesh();
    return a.points == b.points && a.tets == b.tets && a.labels == b.labels;
}

}  // namespace

TEST_CASE(
    "repair in blocks: five meshes, long lists, the same bytes for 1, 2, 3 and 8 threads, and "
    "the mesh of one request after the other") {
    std::size_t commits = 0, rest = 0, all = 0;
    std::uint64_t seed = 1;
    for (test::LabelledMesh& start : start_meshes()) {
        CAPTURE(start.name);
        shake(start.complex, seed);
        Rig one(start.complex), serial(start.complex);
        Workers two(2), three(3), eight(8);
        std::vector<std::unique_ptr<Rig>> others;
        for (int i = 0; i < 3; ++i) others.push_back(std::make_unique<Rig>(start.complex));
        for (int round = 0; round < 4; ++round, ++seed) {
            const bool last = round == 3;
            const auto requests = random_requests(one.complex, seed, 6000, last);
            const auto serial_requests = [&] {
                // The slots differ, so tets and vertices are found again by their births.
                std::map<std::uint32_t, VertexId> vertex;
                std::map<std::array<std::uint32_t, 4>, TetId> tet;
                const auto key = [](const mesh::Complex& c, TetId t) {
                    std::array<std::uint32_t, 4> births{};
                    for (unsigned i = 0; i < 4; ++i) births[i] = c.birth(c.tet(t).v[i]);
                    std::sort(births.begin(), births.end());
                    return births;
                };
                const mesh::Complex& c = serial.complex;
                for (VertexId v = 0; v < c.vertex_slots(); ++v) {
                    if (c.vertex_alive(v)) vertex[c.birth(v)] = v;
                }
                for (TetId t = 0; t < c.tet_slots(); ++t) {
                    if (c.tet_alive(t)) tet[key(c, t)] = t;
                }
                auto out = requests;
                for (repair::Request& r : out) {
                    if (r.tet != mesh::none) {
                        const bool stale = r.birth_date != one.complex.birth_date(r.tet);
                        r.tet = tet.at(key(one.complex, r.tet));
                        r.birth_date = c.birth_date(r.tet) + (stale ? -1U : 0U);
                    }
                    for (VertexId& v : r.vertices) {
                        if (v != mesh::none) v = vertex.at(one.complex.birth(v));
                    }
                }
                return out;
            }();
            const std::uint32_t births = one.complex.next_birth();
            const auto done = run(one, requests, nullptr);
            // Each request was executed once.
            std::vector<int> times(requests.size(), 0);
            for (const Executed& e : done) ++times[e.request];
            REQUIRE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
            check_complex(one.complex);
            // One after the other in the same order: the same outcomes and the same mesh.
            for (const Executed& e : done) {
                if (last) break;
                CAPTURE(e.request);
                CAPTURE(round);
                CAPTURE(repair::name(requests[e.request].operation));
                CAPTURE(static_cast<int>(e.outcome.reason()));
                const Outcome outcome = execute(serial.bench, serial_requests[e.request]);
                CAPTURE(static_cast<int>(outcome.reason()));
                REQUIRE(outcome == e.outcome);
                commits += outcome.refused() ? 0 : 1;
            }
            REQUIRE((last || same_mesh(one.complex, serial.complex)));
            // Births are consecutive: as many as vertices were made.
            CHECK((last || one.complex.next_birth() == serial.complex.next_birth()));
            CHECK(one.complex.next_birth() > births);
            CHECK((last || one.bench.sums.volume == doctest::Approx(serial.bench.sums.volume)));
            CHECK((last || one.bench.crease_exceptions == serial.bench.crease_exceptions));
            for (std::size_t k = 0; k < others.size(); ++k) {
                Workers* workers = std::array{&two, &three, &eight}[k];
                const auto again = run(*others[k], requests, workers);
                REQUIRE(again.size() == done.size());
                for (std::size_t i = 0; i < done.size(); ++i) {
                    REQUIRE(again[i].request == done[i].request);
                    REQUIRE(again[i].outcome == done[i].outcome);
                }
                REQUIRE(bytes_of(others[k]->complex) == bytes_of(one.complex));
            }
            all += done.size();
            rest += serial_rest(done);
        }
    }
    MESSAGE("requests " << all << ", commits " << commits << ", at the end one by one " << rest);
    CHECK(commits > 10000);
    CHECK(rest < all / 2);
}

TEST_CASE("repair in blocks: a field that is linear in space stays linear where edges are split") {
    std::vector<std::string> states;
    for (const unsigned threads : {1U, 3U}) {
        CAPTURE(threads);
        Rig rig(start_meshes().front().complex);
        const mesh::Complex& c = rig.complex;
        const auto height = [&c](VertexId v) {
            return c.position(v).dot(Vec3(1.0, -2.0, 0.5)) + 3.0;
        };
        std::vector<VertexId> vertices(c.interface_vertices().begin(),
                                       c.interface_vertices().end());
        std::vector<double> heights;
        for (const VertexId v : vertices) heights.push_back(height(v));
        rig.fields.set("height", vertices, heights, 0.0);
        rig.bench.lengths = rig.fields.find("height");
        for (const VertexId v : vertices)
            rig.destinations.send(v, c.position(v) + Vec3(0.1, 0.0, 0.0));
        RandomStream random(RandomKey{11, 1, 0, 0});
        std::vector<repair::Request> requests;
        for (int i = 0; i < 3000; ++i) {
            const VertexId v = vertices[random.index(vertices.size())];
            repair::Request r = repair::on_tet(c, c.seed(v), Operation::edge_split);
            const auto& ends = mesh::edge_vertices[random.index(6)];
            r.vertices = {c.tet(r.tet).v[ends[0]], c.tet(r.tet).v[ends[1]], mesh::none};
            r.parameter = static_cast<float>(random.uniform(0.2, 0.8));
            requests.push_back(r);
        }
        Workers workers(threads);
        const auto done = run(rig, requests, &workers);
        check_complex(c);
        CHECK(serial_rest(done) < 600);
        CHECK(c.interface_vertices().size() > vertices.size() + 200);
        // Before settle(), so that only the splits gave values. A split of an edge that has one end
        // on the interface gives the new vertex the value of this end, but it is not on the
        // interface.
        const std::vector<double>& values = *rig.fields.find("height");
        std::size_t known = 0;
        for (const VertexId v : c.interface_vertices()) {
            REQUIRE(values[v] == doctest::Approx(height(v)).epsilon(1e-12));
            ++known;
        }
        CHECK(known == c.interface_vertices().size());
        // New vertices have destinations, and those follow the edge too.
        rig.destinations.pass(rig.bench.limits, PassOptions{});
        StateWriter out;
        c.save(out);
        rig.fields.save(out);
        states.push_back(out.take());
    }
    CHECK(states[0] == states[1]);
}

namespace {

// Steps of a ball that is pushed and twisted at random, with long lists in every step.
Deformer pushed(Deformer d, int from, int to) {
    for (int step = from; step < to; ++step) {
        const mesh::Complex& c = d.complex();
        std::vector<VertexId> vertices(c.interface_vertices().begin(),
                                       c.interface_vertices().end());
        std::sort(vertices.begin(), vertices.end(),
                  [&c](VertexId a, VertexId b) { return c.birth(a) < c.birth(b); });
        std::vector<Vec3> displacements;
        for (const VertexId v : vertices) {
            RandomStream random(RandomKey{9, 1, static_cast<std::uint64_t>(step), c.birth(v)});
            displacements.push_back(
                0.4 * d.target_length() *
                (Vec3(random.normal(), random.normal(), random.normal()) - 0.5 * c.position(v)));
        }
        const StepReport report = d.step(vertices, displacements, test::quality_policy());
        std::uint64_t tried = 0;
        for (const OperationCounts& counts : report.operations) tried += counts.tried;
        CHECK(tried > 4 * RepairBlocks::least_split);
        REQUIRE(mesh::validate(d.complex()).faults == std::vector<std::string>{});
    }
    return d;
}

std::string state_of(const Deformer& d) {
    StateWriter out;
    d.save(out);
    return out.take();
}

}  // namespace

TEST_CASE("deformer: repair in blocks passes the audit, gives the same bytes for 1, 2, 3 and 8 "
          "threads, and goes on from a saved state") {
    DeformerOptions options;
    options.audit = true;
    const auto start = [&](Workers* workers) {
        Deformer d(mesh::adopt(test::ball_grid(22, 1.1), "ball"), options, workers);
        std::vector<VertexId> vertices(d.complex().interface_vertices().begin(),
                                       d.complex().interface_vertices().end());
        std::vector<double> lengths;
        for (const VertexId v : vertices)
            lengths.push_back(d.target_length() * (1.0 + 0.2 * d.complex().position(v).x()));
        d.set_target_lengths(vertices, lengths);
        return d;
    };
    const Deformer whole = pushed(start(nullptr), 0, 3);
    const std::string expected = state_of(whole);
    for (const unsigned threads : {2U, 3U, 8U}) {
        CAPTURE(threads);
        Workers workers(threads);
        CHECK(state_of(pushed(start(&workers), 0, 3)) == expected);
    }
    const std::string saved = state_of(pushed(start(nullptr), 0, 1));
    StateReader in(saved);
    Workers workers(2);
    CHECK(state_of(pushed(Deformer::load(in, options, &workers), 1, 3)) == expected);
}
