// The requests of the strategy, on small complexes with a flat tet of each class.
#include <algorithm>
#include <map>

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>

namespace {

using namespace dsc;
using config::ConfigNode;
using mesh::TetId;
using mesh::VertexId;
using repair::Operation;
using repair::Request;

constexpr double length = 1.0;

// A box of 5^3 cells of five tets, edges 1 and sqrt(2); the middle cell has label 1.
mesh::Complex cells() {
    mesh::TetMesh m;
    constexpr int n = 5;
    for (int k = 0; k <= n; ++k) {
        for (int j = 0; j <= n; ++j) {
            for (int i = 0; i <= n; ++i) m.points.emplace_back(i, j, k);
        }
    }
    for (int cell = 0; cell < n * n * n; ++cell) {
        const int i = cell % n, j = cell / n % n, k = cell / (n * n);
        const int flip = (i + j + k) & 1;
        const auto at = [&](int x, int y, int z) {
            return static_cast<std::uint32_t>(i + (x ^ flip) +
                                              (n + 1) * (j + y + (n + 1) * (k + z)));
        };
        const std::array<std::uint32_t, 4> in = {at(0, 0, 0), at(1, 1, 0), at(1, 0, 1),
                                                 at(0, 1, 1)};
        m.tets.push_back(in);
        m.tets.push_back({in[0], in[1], in[2], at(1, 0, 0)});
        m.tets.push_back({in[0], in[1], in[3], at(0, 1, 0)});
        m.tets.push_back({in[0], in[2], in[3], at(0, 0, 1)});
        m.tets.push_back({in[1], in[2], in[3], at(1, 1, 1)});
        for (int t = 0; t < 5; ++t) m.labels.push_back(i == 2 && j == 2 && k == 2 ? 1 : 0);
    }
    return mesh::adopt(m, "cells", nullptr, 0.0);
}

// Moves a vertex by a fraction of the way to a point.
void move_towards(mesh::Complex& c, VertexId v, const Vec3& target, double part) {
    std::vector<TetId> star;
    c.star(v, star);
    c.move(v, c.position(v) + part * (target - c.position(v)), star);
}

VertexId vertex_at(const mesh::Complex& c, const Vec3& place) {
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        if ((c.position(v) - place).norm() < 1e-9) return v;
    }
    return mesh::none;
}
TetId tet_of(const mesh::Complex& c, std::initializer_list<VertexId> vertices) {
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (std::all_of(vertices.begin(), vertices.end(),
                        [&](VertexId v) { return mesh::has_vertex(c.tet(t), v); }))
            return t;
    }
    return mesh::none;
}

struct Bench {
    explicit Bench(ConfigNode params = ConfigNode::map()) {
        host.load(DSC_TEST_PLUGIN);
        strategy = host.create<hooks::Improvement>({"illinois", std::move(params)}, "improvement");
    }
    struct Round {
        std::vector<TetId> dirty = {};
        std::vector<VertexId> blocked = {};
        unsigned number = 0;
        std::vector<Request> last = {};
        std::vector<repair::Outcome> outcomes = {};
    };
    std::vector<Request> propose(const mesh::Complex& c, const Round& round) {
        const surface::SurfaceView view;
        const hooks::StepContext step{.surface = view, .box = {}, .to_normalised = {}};
        std::vector<Request> out;
        strategy->propose(step,
                          {c, round.dirty, round.blocked, round.last, round.outcomes, length,
                           strategy->flatness(), round.number, true},
                          out);
        return out;
    }
    std::vector<Request> propose_all(const mesh::Complex& c) {
        Round round;
        for (TetId t = 0; t < c.tet_slots(); ++t) round.dirty.push_back(t);
        return propose(c, round);
    }
    std::string class_of(const Request& request) const {
        return strategy->repair_classes().at(request.repair_class);
    }
    host::Host host;
    std::unique_ptr<hooks::Improvement> strategy;
};

std::map<std::string, std::size_t> counts(const Bench& bench,
                                          const std::vector<Request>& requests) {
    std::map<std::string, std::size_t> out;
    for (const Request& r : requests) ++out[bench.class_of(r)];
    return out;
}

const ConfigNode classes_only = ConfigNode::map({{"fallbacks", false}});

// A free vertex of the lattice, and the other vertices of one of its tets.
struct Corner {
    VertexId apex;
    std::array<VertexId, 3> face;
    TetId tet;
};
// The tet between (1,1,1) and its neighbours along the axes: (1,1,1) has an odd sum, so it is the
// corner of eight small tets.
Corner free_corner(const mesh::Complex& c) {
    Corner out{vertex_at(c, {1, 1, 1}),
               {vertex_at(c, {2, 1, 1}), vertex_at(c, {1, 2, 1}), vertex_at(c, {1, 1, 2})},
               mesh::none};
    out.tet = tet_of(c, {out.apex, out.face[0], out.face[1], out.face[2]});
    return out;
}

}  // namespace

TEST_CASE("a mesh of good tets needs no repair") { CHECK(Bench().propose_all(cells()).empty()); }

TEST_CASE("cap: its vertex moves into the face, or the face is removed") {
    mesh::Complex c = cells();
    const Corner corner = free_corner(c);
    REQUIRE(corner.tet != mesh::none);
    move_towards(
        c, corner.apex,
        (c.position(corner.face[0]) + c.position(corner.face[1]) + c.position(corner.face[2])) /
            3.0,
        0.97);
    Bench bench(classes_only);
    const auto requests = bench.propose_all(c);
    REQUIRE(requests.size() == 2);
    for (const Request& r : requests) {
        CHECK(bench.class_of(r) == "cap");
        CHECK(r.tet == corner.tet);
        CHECK(r.birth_date == c.birth_date(corner.tet));
    }
    CHECK(requests[0].operation == Operation::compound);
    CHECK(requests[0].vertices == std::array{corner.apex, mesh::none, mesh::none});
    CHECK(requests[0].gain == 2.0F);
    CHECK(requests[0].least_edge == doctest::Approx(0.25 * length));
    CHECK(requests[1].operation == Operation::face_removal);
    auto named = requests[1].vertices, face = corner.face;
    std::sort(named.begin(), named.end());
    std::sort(face.begin(), face.end());
    CHECK(named == face);
}

TEST_CASE("tee: the vertex moves onto the edge, or the edge is removed; every flat tet of the edge "
          "requests this") {
    mesh::Complex c = cells();
    const Corner corner = free_corner(c);
    const VertexId a = corner.face[0], b = corner.face[1];
    move_towards(c, corner.apex, 0.5 * (c.position(a) + c.position(b)), 0.96);
    Bench bench(classes_only);
    const auto requests = bench.propose_all(c);
    const auto of_class = counts(bench, requests);
    CHECK(of_class.size() == 1);
    CHECK(of_class.at("tee") == 4);  // two tets, two requests each
    for (const Request& r : requests) {
        const bool removal = r.operation == Operation::edge_removal;
        CHECK(removal != (r.operation == Operation::compound));
        if (!removal) {
            CHECK(r.vertices[0] == corner.apex);
            continue;
        }
        CHECK(std::min(r.vertices[0], r.vertices[1]) == std::min(a, b));
        CHECK(std::max(r.vertices[0], r.vertices[1]) == std::max(a, b));
    }
}

TEST_CASE("wedge: the short edge is collapsed within the bounds") {
    mesh::Complex c = cells();
    const Corner corner = free_corner(c);
    move_towards(c, corner.apex, c.position(corner.face[0]), 0.96);
    Bench bench(classes_only);
    const auto requests = bench.propose_all(c);
    CHECK(counts(bench, requests).size() == 1);
    REQUIRE_FALSE(requests.empty());
    for (const Request& r : requests) {
        CHECK(bench.class_of(r) == "wedge");
        CHECK(r.operation == Operation::edge_collapse);
        CHECK(r.mode == repair::CollapseMode::bounded);
        CHECK(r.vertices[2] == mesh::none);
        CHECK(std::min(r.vertices[0], r.vertices[1]) == std::min(corner.apex, corner.face[0]));
        CHECK(std::max(r.vertices[0], r.vertices[1]) == std::max(corner.apex, corner.face[0]));
    }
}

namespace {

// The regular tet of the cell at (i, j, k), its two pairs of vertices with equal z pressed
// together.
TetId press(mesh::Complex& c, double i, double j, double k) {
    std::array<VertexId, 4> v{};
    std::size_t n = 0;
    double sum = 0.0;
    TetId t = mesh::none;
    const Vec3 middle(i + 0.5, j + 0.5, k + 0.5);
    for (TetId s = 0; s < c.tet_slots(); ++s) {
        Vec3 centroid = Vec3::Zero();
        for (const VertexId w : c.tet(s).v) centroid += 0.25 * c.position(w);
        if ((centroid - middle).norm() < 1e-9) t = s;
    }
    for (const VertexId w : c.tet(t).v) v[n++] = w;
    for (const VertexId w : v) sum += c.position(w).z();
    for (const VertexId w : v)
        move_towards(c, w, Vec3(c.position(w).x(), c.position(w).y(), sum / 4), 0.98);
    return t;
}

}  // namespace

TEST_CASE("sliver: its two diagonals are named, as long as the step's budget lasts") {
    mesh::Complex c = cells();
    const TetId t = press(c, 1, 1, 1);
    const auto slivers = [&](ConfigNode params, const Bench::Round& round) {
        Bench bench(std::move(params));
        auto requests = bench.propose(c, round);
        requests.erase(
            std::remove_if(requests.begin(), requests.end(),
                           [&](const Request& r) { return bench.class_of(r) != "sliver"; }),
            requests.end());
        return requests;
    };
    const Bench::Round round{.dirty = {t}};
    const auto requests = slivers(classes_only, round);
    REQUIRE(requests.size() == 1);
    CHECK(requests[0].operation == Operation::compound);
    CHECK(requests[0].vertices[2] == mesh::none);
    // A diagonal of the square, not a side.
    CHECK((c.position(requests[0].vertices[0]) - c.position(requests[0].vertices[1])).norm() > 1.3);
    CHECK(slivers(ConfigNode::map({{"fallbacks", false}, {"insertions", 0.0}}), round).empty());
    // Edges that are not twice the least edge are not split.
    CHECK(slivers(ConfigNode::map({{"fallbacks", false}, {"least_edge", 0.8}}), round).empty());
}

TEST_CASE("the budget counts what was committed, and a new step has a new one") {
    mesh::Complex c = cells();
    const TetId t = press(c, 1, 1, 1);
    // Eight interface vertices: 0.125 of them is one insertion.
    REQUIRE(c.interface_vertices().size() == 8);
    Bench bench(ConfigNode::map({{"fallbacks", false}, {"insertions", 0.125}}));
    Bench::Round round{.dirty = {t}};
    round.last = bench.propose(c, round);
    REQUIRE(round.last.size() == 1);
    round.number = 1;
    round.outcomes = {repair::Refusal::quality};
    CHECK(bench.propose(c, round).size() == 1);
    round.outcomes = {repair::success};
    CHECK(bench.propose(c, round).empty());
    round = {.dirty = {t}};
    CHECK(bench.propose(c, round).size() == 1);
}

TEST_CASE(
    "fall-backs follow the repair of the class, in their order, and only if they are switched on") {
    mesh::Complex c = cells();
    const Corner corner = free_corner(c);
    move_towards(
        c, corner.apex,
        (c.position(corner.face[0]) + c.position(corner.face[1]) + c.position(corner.face[2])) /
            3.0,
        0.97);
    Bench bench;
    const auto requests = bench.propose(c, {.dirty = {corner.tet}});
    std::vector<std::string> order;
    for (const Request& r : requests) {
        if (order.empty() || order.back() != bench.class_of(r)) order.push_back(bench.class_of(r));
    }
    // Smoothing to the mean comes before all tets; smoothing by quality comes with its tet.
    CHECK(order == std::vector<std::string>{"smoothing", "cap", "edge_removal", "face_removal",
                                            "smoothing", "collapse"});
    CHECK(requests.front().operation == Operation::smooth_laplacian);
    for (const Request& r : requests) {
        if (r.operation != Operation::smooth_laplacian && r.operation != Operation::smooth_optimise)
            continue;
        CHECK_FALSE(c.on_interface(r.vertices[0]));
        CHECK_FALSE(c.on_box(r.vertices[0]));
    }
    for (const Request& r : Bench(classes_only).propose(c, {.dirty = {corner.tet}}))
        CHECK(r.repair_class < 4);
}

TEST_CASE("less flat tets are flipped and smoothed, still less flat ones smoothed only") {
    const auto asked = [](double part) {
        mesh::Complex c = cells();
        const Corner corner = free_corner(c);
        move_towards(
            c, corner.apex,
            (c.position(corner.face[0]) + c.position(corner.face[1]) + c.position(corner.face[2])) /
                3.0,
            part);
        Bench bench;
        return counts(bench, bench.propose(c, {.dirty = {corner.tet}}));
    };
    // The altitude is 0.577 (1 - part) edges.
    CHECK(asked(0.60).empty());
    const auto smoothed = asked(0.75);
    CHECK(smoothed.size() == 1);
    CHECK(smoothed.count("smoothing") == 1);
    const auto flipped = asked(0.88);
    CHECK(flipped.count("edge_removal") == 1);
    CHECK(flipped.count("cap") == 0);
    CHECK(flipped.count("collapse") == 0);
    CHECK(asked(0.95).count("cap") == 1);
}

TEST_CASE("a blocked vertex: the worst tet of its star is repaired though it is not flat, once "
          "until something changes") {
    mesh::Complex c = cells();
    const VertexId v = vertex_at(c, {2, 2, 2});
    REQUIRE(c.on_interface(v));
    Bench bench(classes_only);
    Bench::Round round{.blocked = {v}};
    const auto first = bench.propose(c, round);
    REQUIRE_FALSE(first.empty());
    std::vector<TetId> star;
    c.star(v, star);
    const float worst = c.quality(*std::min_element(
        star.begin(), star.end(), [&](TetId a, TetId b) { return c.quality(a) < c.quality(b); }));
    for (const Request& r : first) CHECK(c.quality(r.tet) == worst);
    round.number = 1;
    CHECK(bench.propose(c, round).empty());
    move_towards(c, v, Vec3(2.5, 2.5, 2.5), 0.1);
    CHECK_FALSE(bench.propose(c, round).empty());
    CHECK(bench.propose(c, round).empty());
    round.number = 0;
    CHECK_FALSE(bench.propose(c, round).empty());
}

TEST_CASE("spokes: long edges from the interface into a phase are split on request, longest first, "
          "each once") {
    const mesh::Complex c = cells();
    const auto splits = [&](double longest) {
        Bench bench(ConfigNode::map({{"longest_spoke", longest}}));
        return bench.propose_all(c);
    };
    CHECK(splits(0.0).empty());
    CHECK(splits(1.5).empty());
    std::map<std::array<VertexId, 2>, double> expected;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        for (const auto& e : mesh::edge_vertices) {
            const VertexId a = std::min(c.tet(t).v[e[0]], c.tet(t).v[e[1]]),
                           b = std::max(c.tet(t).v[e[0]], c.tet(t).v[e[1]]);
            if (c.on_interface(a) != c.on_interface(b))
                expected[{a, b}] = (c.position(a) - c.position(b)).norm();
        }
    }
    const auto all = splits(0.9);
    CHECK(all.size() == expected.size());
    double last = 10.0;
    for (const Request& r : all) {
        CHECK(r.operation == Operation::edge_split);
        const double own = expected.at(
            {std::min(r.vertices[0], r.vertices[1]), std::max(r.vertices[0], r.vertices[1])});
        CHECK(own <= last + 1e-6);
        last = own;
    }
    const auto diagonals = splits(1.2);
    CHECK(diagonals.size() ==
          static_cast<std::size_t>(std::count_if(expected.begin(), expected.end(),
                                                 [](const auto& e) { return e.second > 1.2; })));
    CHECK(diagonals.size() > 0);
}

TEST_CASE("no topology changes; the order of proposals does not depend on the order of the dirty "
          "tets except for ties") {
    Bench bench;
    CHECK(bench.strategy->topology_limits().thickness == 0.0);
    CHECK(bench.strategy->topology_limits().min_component == 0.0);
    mesh::Complex c = cells();
    const TetId sliver = press(c, 1, 1, 1);
    const Corner other{vertex_at(c, {4, 4, 1}), {}, mesh::none};
    REQUIRE(other.apex != mesh::none);
    move_towards(c, other.apex, Vec3(4, 3, 1), 0.98);
    std::vector<TetId> star;
    c.star(other.apex, star);
    const auto flattest = *std::min_element(
        star.begin(), star.end(), [&](TetId a, TetId b) { return c.quality(a) < c.quality(b); });
    const auto tets = [&](std::vector<TetId> dirty) {
        Bench fresh(classes_only);
        std::vector<TetId> order;
        for (const Request& r : fresh.propose(c, {.dirty = std::move(dirty)}))
            order.push_back(r.tet);
        return order;
    };
    const auto forward = tets({sliver, flattest});
    CHECK(forward == tets({flattest, sliver}));
    CHECK(forward.front() == flattest);
    CHECK(forward.back() == sliver);
}
