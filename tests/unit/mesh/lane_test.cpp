// Lanes: slots, births, dates and lists of changes of work side by side.
#include <algorithm>

#include <doctest/doctest.h>

#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

#include "meshes.hpp"

using namespace dsc;
using namespace dsc::mesh;

namespace {

// The split of edge (a, b) of tet t at its middle; false if the edge is on the box.
bool plan_split(const Complex& c, TetId t, VertexId a, VertexId b, Edit& edit) {
    EdgeRing ring;
    c.ring(t, a, b, ring);
    if (!ring.closed) return false;
    edit.clear();
    edit.creates = true;
    edit.created_at = 0.5 * (c.position(a) + c.position(b));
    for (std::size_t i = 0; i < ring.tets.size(); ++i) {
        const VertexId p = ring.link[i], q = ring.link[(i + 1) % ring.link.size()];
        edit.removed.push_back(ring.tets[i]);
        edit.added.push_back({{a, created_vertex, p, q}, c.label(ring.tets[i])});
        edit.added.push_back({{created_vertex, b, p, q}, c.label(ring.tets[i])});
    }
    return true;
}

// An inner edge of the complex on the side x < 0 or x > 0, far from the plane between.
TetId tet_beside(const Complex& c, double side, Edit& edit) {
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (!c.tet_alive(t)) continue;
        const auto& v = c.tet(t).v;
        if (!std::all_of(v.begin(), v.end(),
                         [&](VertexId x) { return side * c.position(x).x() > 0.6; }))
            continue;
        if (plan_split(c, t, v[0], v[1], edit)) return t;
    }
    return none;
}

}  // namespace

TEST_CASE("a lane without slots refuses an edit and changes nothing") {
    Complex c = adopt(test::ball_grid(8), "ball");
    Edit edit;
    REQUIRE(tet_beside(c, 1.0, edit) != none);
    const std::size_t more = edit.added.size() - edit.removed.size();
    const std::size_t tets = c.tet_count(), vertices = c.vertex_count();
    for (const LaneRoom room : {LaneRoom{0, 0}, LaneRoom{more - 1, 1}, LaneRoom{more, 0}}) {
        Lane lane;
        c.open(lane, room);
        CHECK_FALSE(c.link(edit, lane));
        CHECK(lane.take_shortage());
        CHECK_FALSE(lane.take_shortage());
        c.close(lane);
        CHECK(c.tet_count() == tets);
        CHECK(c.vertex_count() == vertices);
        CHECK(validate(c).faults == std::vector<std::string>{});
    }
    Lane lane;
    c.open(lane, {more, 1});
    const std::uint32_t birth = c.next_birth();
    REQUIRE(c.link(edit, lane));
    CHECK_FALSE(lane.take_shortage());
    const VertexId v = c.replace(edit, lane);
    c.close(lane);
    CHECK(c.birth(v) == birth);
    CHECK(c.next_birth() == birth + 1);
    CHECK(c.tet_count() == tets + more);
    CHECK(validate(c).faults == std::vector<std::string>{});
    // Refused for another reason: this is no shortage.
    edit.added.pop_back();
    c.open(lane, {100, 1});
    CHECK_FALSE(c.link(edit, lane));
    CHECK_FALSE(lane.take_shortage());
    c.close(lane);
}

TEST_CASE("two lanes: births by lane, one clock, all changes, deleted vertices wait for the end") {
    Complex c = adopt(test::ball_grid(10), "ball");
    std::vector<TetId> changes;
    c.take_changes(changes);
    const std::uint32_t birth = c.next_birth(), clock = c.clock();
    const std::vector<VertexId> listed(c.interface_vertices().begin(),
                                       c.interface_vertices().end());
    Lane left, right;
    c.open(left, {200, 4});
    c.open(right, {200, 4});
    Edit edit;
    // In the order right, left, right, left: the births must not show it.
    std::vector<VertexId> made_left, made_right;
    for (int i = 0; i < 3; ++i) {
        for (const double side : {1.0, -1.0}) {
            REQUIRE(tet_beside(c, side, edit) != none);
            Lane& lane = side > 0.0 ? right : left;
            REQUIRE(c.link(edit, lane));
            (side > 0.0 ? made_right : made_left).push_back(c.replace(edit, lane));
        }
    }
    CHECK(left.clock() == clock + 3);
    CHECK(c.clock() == clock);
    // One more on the left, which is collapsed again: its slot must not be used for the next one.
    REQUIRE(tet_beside(c, -1.0, edit) != none);
    const VertexId a = edit.added.front().v[0];
    REQUIRE(c.link(edit, left));
    const VertexId gone = c.replace(edit, left);
    TetIndex walk;
    std::vector<TetId> star;
    c.cached_star(gone, star, walk);
    edit.clear();
    edit.removed = star;
    edit.deleted = gone;
    for (const TetId t : star) {
        if (has_vertex(c.tet(t), a)) continue;
        NewTet tet{c.tet(t).v, c.label(t)};
        std::replace(tet.v.begin(), tet.v.end(), gone, a);
        edit.added.push_back(tet);
    }
    REQUIRE(c.link(edit, left));
    CHECK(c.replace(edit, left) == none);
    REQUIRE(tet_beside(c, -1.0, edit) != none);
    CHECK_FALSE(c.link(edit, left));
    CHECK(left.take_shortage());
    CHECK(std::equal(listed.begin(), listed.end(), c.interface_vertices().begin(),
                     c.interface_vertices().end()));
    c.close(left);
    c.close(right);
    CHECK(validate(c).faults == std::vector<std::string>{});
    CHECK(c.clock() == clock + 5);
    for (std::uint32_t i = 0; i < 3; ++i) {
        CHECK(c.birth(made_left[i]) == birth + i);
        CHECK(c.birth(made_right[i]) == birth + 4 + i);
    }
    CHECK(c.next_birth() == birth + 7);
    // Every live tet that is younger than the start is in the list, once.
    c.take_changes(changes);
    std::sort(changes.begin(), changes.end());
    CHECK(std::adjacent_find(changes.begin(), changes.end()) == changes.end());
    for (TetId t = 0; t < c.tet_slots(); ++t) {
        if (c.tet_alive(t) && c.date(t) > clock)
            REQUIRE(std::binary_search(changes.begin(), changes.end(), t));
    }
    // The next vertex takes a slot that a lane did not use or has given back.
    const std::size_t slots = c.vertex_slots();
    REQUIRE(tet_beside(c, 1.0, edit) != none);
    REQUIRE(c.link(edit));
    c.replace(edit);
    CHECK(c.vertex_slots() == slots);
}

TEST_CASE("a lane's changes of labels reach the list of the interface when it is closed") {
    Complex c = adopt(test::grid(8, 1.5, [](const Vec3&) { return 0; }), "empty");
    CHECK(c.interface_vertices().empty());
    TetId inner = none;
    for (TetId t = 0; t < c.tet_slots() && inner == none; ++t) {
        const auto& v = c.tet(t).v;
        if (std::none_of(v.begin(), v.end(), [&](VertexId x) { return c.on_box(x); })) inner = t;
    }
    REQUIRE(inner != none);
    Lane lane;
    c.open(lane, {});
    c.relabel(std::span(&inner, 1), 1, lane);
    for (const VertexId v : c.tet(inner).v) CHECK(c.phases(v) == 2);
    CHECK(c.interface_vertices().empty());
    c.close(lane);
    std::vector<VertexId> expected(c.tet(inner).v.begin(), c.tet(inner).v.end()),
        listed(c.interface_vertices().begin(), c.interface_vertices().end());
    std::sort(expected.begin(), expected.end());
    std::sort(listed.begin(), listed.end());
    CHECK(listed == expected);
    // There and back within one lane.
    c.open(lane, {});
    c.relabel(std::span(&inner, 1), 0, lane);
    c.relabel(std::span(&inner, 1), 2, lane);
    c.relabel(std::span(&inner, 1), 0, lane);
    c.close(lane);
    CHECK(c.interface_vertices().empty());
    CHECK(validate(c).faults == std::vector<std::string>{});
}
