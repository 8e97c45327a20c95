// Visits that ask the memory ahead see every tet once, in the order of the list.
#include <algorithm>

#include <doctest/doctest.h>

#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/tet_visit.hpp>

#include "meshes.hpp"

using namespace dsc;
using mesh::TetId;

TEST_CASE("tet visit: every tet of the list in its order; only live tets are asked, once each") {
    mesh::Complex c = mesh::adopt(test::ball_grid(6, 0.8), "ball");
    // A collapse, so that some slots are dead.
    mesh::Edit edit;
    for (mesh::VertexId v = 0; v < c.vertex_slots() && edit.removed.empty(); ++v) {
        if (!c.interior(v)) continue;
        std::vector<TetId> star;
        c.star(v, star);
        for (const mesh::VertexId kept : c.tet(star.front()).v) {
            if (kept == v) continue;
            edit.clear();
            edit.deleted = v;
            edit.removed = star;
            for (const TetId t : star) {
                if (mesh::has_vertex(c.tet(t), kept)) continue;
                mesh::NewTet tet{c.tet(t).v, c.label(t)};
                std::replace(tet.v.begin(), tet.v.end(), v, kept);
                edit.added.push_back(tet);
            }
            break;
        }
    }
    REQUIRE(c.link(edit));
    c.replace(edit);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{6}, std::size_t{16},
                                    std::size_t{17}, std::size_t{41}, c.tet_slots()}) {
        CAPTURE(count);
        // In no order of memory.
        std::vector<TetId> tets;
        for (std::size_t i = 0; i < count; ++i)
            tets.push_back(static_cast<TetId>(i * 7919 % c.tet_slots()));
        std::vector<TetId> asked;
        std::size_t visited = 0, dead = 0;
        mesh::visit_tets(
            c, tets,
            [&](TetId t) {
                REQUIRE(c.tet_alive(t));
                asked.push_back(t);
                return t % 2 == 0;
            },
            [&](std::size_t i) {
                REQUIRE(i == visited);
                ++visited;
                dead += c.tet_alive(tets[i]) ? 0 : 1;
            });
        CHECK(visited == count);
        // The first visits begin before the memory was asked for anything.
        std::vector<TetId> expected;
        for (std::size_t i = 0; i < count; ++i) {
            if (i >= 16 && c.tet_alive(tets[i])) expected.push_back(tets[i]);
        }
        CHECK(asked == expected);
        if (count == c.tet_slots()) CHECK(dead > 0);
    }
}
