// Long seeded sequences of mixed operations over five start meshes; every invariant, exactly, after
// every 100th.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/geometry/predicates.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/mesh/local_star.hpp>
#include <dsc/mesh/unpinch.hpp>
#include <dsc/mesh/validate.hpp>

#include "kernel/movement.hpp"
#include "kernel/operations.hpp"
#include "kernel/topology.hpp"
#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using repair::Operation;

namespace {

constexpr std::size_t sequence_length = 54000;  // of each of the five meshes

struct Tally {
    std::array<std::size_t, repair::operation_count> tried{}, committed{};
    std::array<std::array<std::size_t, repair::refusal_count>, repair::operation_count> refused{};
    std::array<std::size_t, repair::refusal_count> reasons{};
    std::array<std::size_t, 7> events{};
    std::size_t moves = 0, operations = 0;
};

// Volumes by label.
std::map<mesh::Label, double> volumes(const mesh::Complex& c) {
    std::map<mesh::Label, double> out;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (c.tet_alive(t)) out[c.label(t)] += c.volume(t);
    }
    return out;
}

bool keeps_labels(Operation o) {
    return o == Operation::smooth_laplacian || o == Operation::smooth_optimise ||
           o == Operation::edge_removal || o == Operation::face_removal ||
           o == Operation::edge_split || o == Operation::vertex_split;
}

repair::Request random_request(const mesh::Complex& c, RandomStream& random, Operation operation) {
    repair::Request r;
    r.operation = operation;
    TetId t = static_cast<TetId>(random.index(c.tet_slots()));
    // Mostly at the interface, where things are delicate.
    if (random.index(5) != 0 && !c.interface_vertices().empty()) {
        t = c.seed(c.interface_vertices()[random.index(c.interface_vertices().size())]);
    }
    r.tet = t;
    r.birth_date = c.birth_date(t);
    r.mode = random.index(2) == 0 ? repair::CollapseMode::safe : repair::CollapseMode::bounded;
    r.accept_above = random.index(4) == 0 ? 2.0F : 0.0F;
    r.parameter = static_cast<float>(random.uniform(0.05, 0.95));
    if (!c.tet_alive(t)) return r;
    const bool needs_vertex =
        operation == Operation::smooth_laplacian || operation == Operation::smooth_optimise;
    const bool needs_edge = operation == Operation::vertex_split;
    const auto& e = mesh::edge_vertices[random.index(6)];
    if (needs_vertex) r.vertices[0] = c.tet(t).v[e[0]];
    if (needs_edge || (random.index(3) == 0 && operation != Operation::compound &&
                       operation != Operation::relabel && operation != Operation::face_removal &&
                       operation != Operation::face_split && !needs_vertex)) {
        r.vertices = {c.tet(t).v[e[0]], c.tet(t).v[e[1]], mesh::none};
    }
    return r;
}

// As a plugin would: a tet that touches neither interface nor box becomes a component of its own.
bool give_birth(mesh::Complex& c, Workbench& bench, TopologyStage& stage, RandomStream& random,
                std::uint64_t n, std::vector<Event>& events) {
    for (int attempt = 0; attempt < 50; ++attempt) {
        const auto t = static_cast<TetId>(random.index(c.tet_slots()));
        if (!c.tet_alive(t)) continue;
        const auto& v = c.tet(t).v;
        if (std::any_of(v.begin(), v.end(),
                        [&](VertexId x) { return c.on_interface(x) || c.on_box(x); }))
            continue;
        Region region;
        region.tets.assign(1, t);
        region.from = c.label(t);
        region.to = region.from == 0 ? 1 : 0;
        if (measure(bench, region) != RegionFault::none || !regular(bench, region)) continue;
        events.push_back(stage.commit(region, n));
        return true;
    }
    return false;
}

// As a plugin's relabelling: a tet takes the other label without regard to its corners, and what is
// pinched then is opened. Returns how many vertices were; 0 where nothing was pinched or the
// opening was refused.
std::size_t pinch_and_open(mesh::Complex& c, RandomStream& random) {
    for (int attempt = 0; attempt < 50; ++attempt) {
        const auto t = static_cast<TetId>(random.index(c.tet_slots()));
        if (!c.tet_alive(t) || c.label(t) > 1) continue;
        const auto corners = c.tet(t).v;
        if (std::any_of(corners.begin(), corners.end(), [&](VertexId x) { return c.on_box(x); }))
            continue;
        const mesh::Complex before = c;
        c.relabel(std::span(&t, 1), c.label(t) == 0 ? 1 : 0);
        mesh::LocalStar star(c);
        std::vector<VertexId> touched(corners.begin(), corners.end());
        std::sort(touched.begin(), touched.end(),
                  [&c](VertexId a, VertexId b) { return c.birth(a) < c.birth(b); });
        const bool pinched = std::any_of(touched.begin(), touched.end(), [&](VertexId v) {
            star.build(v);
            return !star.regular();
        });
        if (pinched) {
            try {
                const std::size_t opened = mesh::unpinch(c, "sequence", touched);
                if (opened > 0) return opened;
            } catch (const GeometryError&) {  // no room: as a plugin's request it would be refused
                                              // whole
            }
        }
        c = before;
    }
    return 0;
}

void run_sequence(mesh::Complex& c, std::uint64_t seed, Tally& tally) {
    const mesh::Complex start = c;
    RandomStream random(RandomKey{seed, 1, 2, 3});
    Workbench bench(c);
    const double length = 0.42;
    bench.limits = {length, 1e-3, 0.5 * length, geometry::regular_tet_volume(length), 0.995};
    TopologyStage stage(bench);
    repair::TopologyLimits limits;
    limits.thickness = 10.0;
    std::vector<Event> events;
    std::vector<TetId> all;
    mesh::InterfaceCounts counts = mesh::count_interface(c);
    const std::size_t smallest = c.tet_count() / 2, largest = 2 * c.tet_count();
    for (std::size_t n = 0; n < sequence_length; ++n) {
        ++tally.operations;
        Operation operation = static_cast<Operation>(random.index(repair::operation_count));
        // Keep the size of the mesh: splits and collapses pull it either way.
        if (c.tet_count() > largest && operation >= Operation::edge_split &&
            operation <= Operation::vertex_split) {
            operation = Operation::edge_collapse;
        }
        if (c.tet_count() < smallest && operation == Operation::edge_collapse)
            operation = Operation::edge_split;
        if (random.index(12) == 0 && !c.interface_vertices().empty()) {
            const VertexId v = c.interface_vertices()[random.index(c.interface_vertices().size())];
            const Vec3 d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            if (c.movable(v)) {
                ++tally.moves;
                move_towards(bench, v, c.position(v) + length * d, 0.9);
            }
        }
        // Diagonals of bent quadrilaterals too, half of the time.
        bench.limits.flatness = n % 2 == 0 ? 0.995 : 0.5;
        // Flat configurations on purpose: with the floor at 0 only the exact predicate stands
        // between a flat tet and the complex.
        bench.limits.quality_floor = n % 3 == 0 ? 0.0 : 1e-3;
        repair::Request request = random_request(c, random, operation);
        if (n % 3 == 0) request.accept_above = -1.0F;
        const bool conserved = keeps_labels(operation) && n % 10 == 0;
        const auto before = conserved ? volumes(c) : std::map<mesh::Label, double>{};
        const Outcome outcome = execute(bench, request);
        const auto o = static_cast<std::size_t>(operation);
        ++tally.tried[o];
        ++tally.reasons[static_cast<std::size_t>(outcome.reason())];
        if (!outcome.refused()) {
            ++tally.committed[o];
        } else {
            ++tally.refused[o][static_cast<std::size_t>(outcome.reason())];
        }
        if (conserved) {
            const auto after = volumes(c);
            REQUIRE(after.size() == before.size());
            for (const auto& [label, volume] : before)
                REQUIRE(after.at(label) == doctest::Approx(volume).epsilon(1e-11));
        }
        if (n % 100 != 99) continue;
        const mesh::ComplexReport report = mesh::validate(c);
        CAPTURE(n);
        for (const std::string& fault : report.faults) FAIL(fault);
        const mesh::InterfaceCounts now = mesh::count_interface(c);
        REQUIRE(now.shells == counts.shells);
        REQUIRE(now.euler() == counts.euler());
        // A topology stage now and then, every event counted against the recount.
        all.clear();
        for (TetId t = 0; t < c.tet_slots(); ++t) all.push_back(t);
        events.clear();
        stage.run(n, all, limits, {}, events);
        long shells = 0, genus = 0;
        for (const Event& event : events) {
            ++tally.events[static_cast<std::size_t>(event.kind)];
            shells += (event.kind == Event::Kind::split ? 1 : 0) -
                      (event.kind == Event::Kind::merge ? 1 : 0) -
                      (event.kind == Event::Kind::vanished ? 1 : 0);
            genus += (event.kind == Event::Kind::handle_opened ? 1 : 0) -
                     (event.kind == Event::Kind::handle_closed ? 1 : 0);
        }
        const mesh::InterfaceCounts then = mesh::count_interface(c);
        REQUIRE(static_cast<long>(then.shells) - static_cast<long>(now.shells) == shells);
        REQUIRE(then.genus() - now.genus() == genus);
        // Births and the vanishing of what stays small, on the same books.
        events.clear();
        if (n % 400 == 399) give_birth(c, bench, stage, random, n, events);
        std::vector<VertexId> near(c.interface_vertices().begin(), c.interface_vertices().end());
        if (n % 800 == 799) stage.remove_small_components(n, near, 4.0, events);
        shells = 0;
        for (const Event& event : events) {
            ++tally.events[static_cast<std::size_t>(event.kind)];
            shells += event.kind == Event::Kind::born ? 1 : -1;
        }
        counts = mesh::count_interface(c);
        REQUIRE(static_cast<long>(counts.shells) - static_cast<long>(then.shells) == shells);
        REQUIRE(counts.genus() == then.genus());
        if (n % 500 == 499) {
            tally.events[static_cast<std::size_t>(Event::Kind::unpinched)] +=
                pinch_and_open(c, random);
            REQUIRE(mesh::validate(c).faults == std::vector<std::string>{});
            counts = mesh::count_interface(c);
        }
        if (n % 3000 == 2999) {
            c = start;
            counts = mesh::count_interface(c);
        }
    }
}

}  // namespace

TEST_CASE("random sequences of mixed operations over five start meshes keep every invariant") {
    Tally tally;
    const std::uint64_t exact_before = geometry::exact_fallbacks();
    auto meshes = test::labelled_meshes();
    std::uint64_t seed = 1;
    for (const std::size_t index : {1U, 2U, 3U, 6U, 7U}) {
        CAPTURE(meshes[index].name);
        run_sequence(meshes[index].complex, seed++, tally);
    }
    const std::uint64_t exact = geometry::exact_fallbacks() - exact_before;
    std::ostringstream table;
    std::size_t commits = 0;
    for (std::size_t o = 0; o < repair::operation_count; ++o) {
        table << "\n"
              << repair::name(static_cast<Operation>(o)) << ": tried " << tally.tried[o]
              << ", committed " << tally.committed[o];
        for (std::size_t r = 1; r < repair::refusal_count; ++r) {
            if (tally.refused[o][r] > 0)
                table << ", " << repair::name(static_cast<Refusal>(r)) << " "
                      << tally.refused[o][r];
        }
        commits += tally.committed[o];
    }
    table << "\nevents:";
    for (std::size_t k = 0; k < 7; ++k)
        table << " " << name(static_cast<Event::Kind>(k)) << " " << tally.events[k];
    MESSAGE("operations " << tally.operations << ", commits " << commits << ", moves "
                          << tally.moves << ", exact fallbacks " << exact << table.str());
    CHECK(tally.operations >= 200000);
    CHECK(commits >= 40000);
    CHECK(exact >= 1000);
    for (std::size_t o = 0; o < repair::operation_count; ++o) {
        CAPTURE(repair::name(static_cast<Operation>(o)));
        CHECK(tally.committed[o] >= 1000);
    }
    for (const Refusal r : {Refusal::irregular, Refusal::quality, Refusal::bound, Refusal::box}) {
        CAPTURE(repair::name(r));
        CHECK(tally.reasons[static_cast<std::size_t>(r)] >= 1000);
    }
    for (std::size_t k = 0; k < 7; ++k) {
        CAPTURE(name(static_cast<Event::Kind>(k)));
        CHECK(tally.events[k] >= 100);
    }
}
