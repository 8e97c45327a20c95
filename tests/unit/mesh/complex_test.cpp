#include <algorithm>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

#include <dsc/geometry/predicates.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/local_star.hpp>
#include <dsc/mesh/validate.hpp>

#include "meshes.hpp"

using namespace dsc;
using namespace dsc::mesh;

TEST_CASE("the thesis' cube: counts of the complex and of its interface") {
    const Complex c = adopt(test::cube_grid(30), "cube");
    CHECK(c.vertex_count() == 29791);
    CHECK(c.tet_count() == 135000);
    const InterfaceCounts counts = count_interface(c);
    CHECK(counts.vertices == 2402);
    CHECK(counts.faces == 4800);
    CHECK(counts.edges == 7200);
    CHECK(counts.shells == 1);
    CHECK(counts.genus() == 0);
    CHECK(c.interface_vertices().size() == 2402);
    CHECK(labelled_volume(c) == doctest::Approx(8.0).epsilon(1e-12));
    const ComplexReport report = validate(c);
    CHECK(report.faults == std::vector<std::string>{});
    CHECK(report.min_quality == doctest::Approx(0.7698).epsilon(1e-4));
}

TEST_CASE("star and ring agree with a full scan") {
    const Complex c = adopt(test::ball_grid(6), "ball");
    std::vector<TetId> star;
    for (VertexId v = 0; v < c.vertex_slots(); ++v) {
        c.star(v, star);
        std::set<TetId> found(star.begin(), star.end());
        CHECK(found.size() == star.size());
        std::set<TetId> expected;
        for (TetId t = 0; t < c.tet_slots(); ++t) {
            if (has_vertex(c.tet(t), v)) expected.insert(t);
        }
        REQUIRE(found == expected);
    }
    EdgeRing ring;
    for (TetId t = 0; t < c.tet_slots(); t += 7) {
        for (const auto& e : edge_vertices) {
            const VertexId a = c.tet(t).v[e[0]], b = c.tet(t).v[e[1]];
            c.ring(t, a, b, ring);
            std::set<TetId> expected;
            for (TetId s = 0; s < c.tet_slots(); ++s) {
                if (has_vertex(c.tet(s), a) && has_vertex(c.tet(s), b)) expected.insert(s);
            }
            REQUIRE(std::set<TetId>(ring.tets.begin(), ring.tets.end()) == expected);
            REQUIRE(ring.link.size() == ring.tets.size() + (ring.closed ? 0 : 1));
            for (std::size_t i = 0; i < ring.tets.size(); ++i) {
                const VertexId p = ring.link[i], q = ring.link[(i + 1) % ring.link.size()];
                REQUIRE(has_vertex(c.tet(ring.tets[i]), p));
                REQUIRE(has_vertex(c.tet(ring.tets[i]), q));
                REQUIRE(geometry::orient3d(c.position(a), c.position(b), c.position(p),
                                           c.position(q)) == 1);
            }
        }
    }
    CHECK(c.find_edge(0, 1) != none);
    CHECK(c.find_edge(0, static_cast<VertexId>(c.vertex_slots() - 1)) == none);
}

TEST_CASE("an edge split and its inverse through replace()") {
    Complex c = adopt(test::ball_grid(6), "ball");
    const double before = labelled_volume(c);
    Edit edit;
    EdgeRing ring;
    int splits = 0;
    for (TetId t = 0; t < 1000; t += 37) {
        const VertexId a = c.tet(t).v[0], b = c.tet(t).v[1];
        c.ring(t, a, b, ring);
        if (!ring.closed) continue;
        edit.clear();
        edit.creates = true;
        edit.created_at = 0.5 * (c.position(a) + c.position(b));
        for (std::size_t i = 0; i < ring.tets.size(); ++i) {
            const VertexId p = ring.link[i], q = ring.link[(i + 1) % ring.link.size()];
            edit.removed.push_back(ring.tets[i]);
            edit.added.push_back({{a, created_vertex, p, q}, c.label(ring.tets[i])});
            edit.added.push_back({{created_vertex, b, p, q}, c.label(ring.tets[i])});
        }
        REQUIRE(c.link(edit));
        const VertexId v = c.replace(edit);
        ++splits;
        REQUIRE(c.vertex_alive(v));
        REQUIRE(validate(c).faults == std::vector<std::string>{});
        if (splits % 2 == 0) continue;
        // Collapse v into a again.
        std::vector<TetId> star;
        c.star(v, star);
        edit.clear();
        edit.removed = star;
        edit.deleted = v;
        for (const TetId s : star) {
            if (has_vertex(c.tet(s), a)) continue;
            NewTet tet{c.tet(s).v, c.label(s)};
            std::replace(tet.v.begin(), tet.v.end(), v, a);
            edit.added.push_back(tet);
        }
        REQUIRE(c.link(edit));
        CHECK(c.replace(edit) == none);
        REQUIRE(validate(c).faults == std::vector<std::string>{});
        CHECK(c.tet_count() < c.tet_slots());
        for (TetId s = 0; s < c.tet_slots(); ++s) REQUIRE(c.in_use(s) == c.tet_alive(s));
    }
    CHECK(splits > 10);
    CHECK(labelled_volume(c) == doctest::Approx(before).epsilon(1e-12));
}

TEST_CASE("link refuses a filling that does not close") {
    Complex c = adopt(test::ball_grid(6), "ball");
    Edit edit;
    edit.removed = {100};
    CHECK_FALSE(c.link(edit));
    edit.added = {{c.tet(100).v, 0}, {c.tet(100).v, 0}};
    CHECK_FALSE(c.link(edit));
    edit.added = {{c.tet(100).v, 0}};
    CHECK(c.link(edit));
    edit.added = {{c.tet(300).v, 0}};
    CHECK_FALSE(c.link(edit));
}

TEST_CASE("the memory of a taken change list serves for the next changes") {
    Complex c = adopt(test::ball_grid(6), "ball");
    LargeVector<TetId> changes;
    c.take_changes(changes);
    const TetId* const memory = changes.data();
    c.reuse(changes);
    CHECK(changes.empty());
    const VertexId v = c.interface_vertices().front();
    std::vector<TetId> star;
    c.star(v, star);
    c.move(v, c.position(v) + Vec3(0.01, 0.0, 0.0), star);
    CHECK(c.changes().size() == star.size());
    CHECK(c.changes().data() == memory);
    // A list that is in use stays.
    LargeVector<TetId> other = {1, 2, 3};
    c.reuse(other);
    CHECK(other.empty());
    CHECK(c.changes().size() == star.size());
}

TEST_CASE("moves and relabels keep the caches") {
    Complex c = adopt(test::ball_grid(6), "ball");
    std::vector<TetId> star;
    LargeVector<TetId> changes;
    c.take_changes(changes);
    CHECK(changes.size() == c.tet_count());
    VertexId inside = none;
    for (const VertexId v : c.interface_vertices()) inside = v;
    c.star(inside, star);
    c.move(inside, c.position(inside) + Vec3(0.01, 0.02, -0.01), star);
    CHECK(validate(c).faults == std::vector<std::string>{});
    CHECK(c.changes().size() == star.size());
    for (const TetId t : star) CHECK(c.date(t) == c.clock());
    // One tet that touches nothing else of its label makes four new interface vertices, all
    // regular.
    TetId lonely = none;
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        const auto& v = c.tet(t).v;
        if (std::none_of(v.begin(), v.end(),
                         [&](VertexId x) { return c.on_interface(x) || c.on_box(x); }))
            lonely = t;
    }
    REQUIRE(lonely != none);
    const std::size_t interface = c.interface_vertices().size();
    const Label old = c.label(lonely);
    c.relabel(std::span(&lonely, 1), 7);
    CHECK(c.interface_vertices().size() == interface + 4);
    CHECK(count_interface(c).shells == 2);
    CHECK(validate(c).faults == std::vector<std::string>{});
    c.relabel(std::span(&lonely, 1), old);
    CHECK(c.interface_vertices().size() == interface);
}

TEST_CASE("to_mesh is independent of slots and adopts again") {
    Complex c = adopt(test::torus_grid(10), "torus");
    std::vector<VertexId> ids;
    const TetMesh m = c.to_mesh(&ids);
    CHECK(m.points.size() == c.vertex_count());
    const Complex again = adopt(m, "again");
    const TetMesh n = again.to_mesh();
    CHECK(n.points == m.points);
    CHECK(n.tets == m.tets);
    CHECK(n.labels == m.labels);
}

TEST_CASE("local stars: the classic cases of regular and pinched vertices") {
    // Centre of a 2x2x2 grid: one octant, two opposite octants, two octants sharing an edge, half.
    const auto pinch = [](const std::function<bool(const Vec3&)>& in) {
        const TetMesh m = test::grid(
            4, 1.0, [&](const Vec3& p) { return p.cwiseAbs().maxCoeff() < 0.5 && in(p) ? 1 : 0; });
        // Neighbours by adopting a mesh with plain labels, labels put on afterwards.
        TetMesh plain = m;
        std::fill(plain.labels.begin(), plain.labels.end(), 0);
        Complex c = adopt(plain, "plain");
        std::vector<TetId> ones;
        for (TetId t = 0; t < c.tet_slots(); ++t) {
            if (m.labels[t] == 1) ones.push_back(t);
        }
        c.relabel(ones, 1);
        VertexId centre = none;
        for (VertexId v = 0; v < c.vertex_slots(); ++v) {
            if (c.position(v).norm() < 1e-12) centre = v;
        }
        LocalStar star(c);
        star.build(centre);
        return std::pair(star.regular(), star.groups());
    };
    CHECK(pinch([](const Vec3& p) { return p.minCoeff() > 0; }) == std::pair(true, 2U));
    CHECK(pinch([](const Vec3& p) { return p.x() > 0; }) == std::pair(true, 2U));
    CHECK(pinch([](const Vec3& p) { return p.minCoeff() > 0 || p.maxCoeff() < 0; }) ==
          std::pair(false, 3U));
    CHECK(pinch([](const Vec3& p) { return p.x() * p.y() > 0; }) == std::pair(false, 4U));
}
