// Blocks of space: about equal parts, and the vertices whose neighbours are in the same block.
#include "kernel/space_blocks.hpp"

#include <doctest/doctest.h>

#include "shapes.hpp"

using namespace dsc;
using namespace dsc::kernel;
using mesh::TetId;
using mesh::VertexId;

TEST_CASE("blocks of space: about equal parts, and inner vertices as a full scan finds them") {
    const mesh::Complex c = test::by_cells(
        [](int i, int j, int k) {
            return test::between(3, i, 16) && test::between(3, j, 16) && test::between(3, k, 16)
                       ? 1
                       : 0;
        },
        20);
    SpaceBlocks blocks(c);
    std::vector<TetId> star, scratch;
    mesh::TetIndex walk;
    for (unsigned wave = 0; wave < 3; ++wave) {
        for (unsigned levels = 1; levels <= SpaceBlocks::most_levels; ++levels) {
            CAPTURE(wave);
            CAPTURE(levels);
            std::vector<VertexId> vertices(c.interface_vertices().begin(),
                                           c.interface_vertices().end());
            blocks.split(vertices, levels, wave, nullptr);
            REQUIRE(blocks.count() == 1U << levels);
            std::vector<std::size_t> sizes(blocks.count(), 0);
            for (const VertexId v : vertices) ++sizes[blocks.block_of(v)];
            // A plane may contain many vertices of a grid.
            for (const std::size_t size : sizes) {
                CHECK(size > vertices.size() / blocks.count() / 4);
                CHECK(size < 4 * vertices.size() / blocks.count());
            }
            std::size_t inner = 0;
            for (VertexId v = 0; v < c.vertex_slots(); ++v) {
                c.star(v, star);
                bool together = true;
                for (const TetId t : star) {
                    for (const VertexId w : c.tet(t).v)
                        together = together && blocks.block_of(w) == blocks.block_of(v);
                }
                for (unsigned b = 0; b < blocks.count(); ++b) {
                    REQUIRE(blocks.inner(v, b, scratch, walk) ==
                            (together && b == blocks.block_of(v)));
                }
                inner += together ? 1 : 0;
            }
            CHECK(inner > c.vertex_count() / 4);
        }
    }
}
