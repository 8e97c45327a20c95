#include "generate/cell_set.hpp"

#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>

TEST_CASE("sets of cells grow and coarsen, across words and up to the walls") {
    using dsc::generate::lattice::Cell;
    using dsc::generate::lattice::CellSet;
    for (const int side : {6, 64, 130}) {
        CAPTURE(side);
        for (const Cell& seed : {Cell{0, 0, 0}, Cell{side - 1, side - 1, side - 1},
                                 Cell{side / 2, 1, side - 1}, Cell{std::min(63, side - 1), 2, 3}}) {
            CellSet set(static_cast<unsigned>(side));
            set.add(seed);
            const CellSet grown = set.grown(1), parents = grown.parents();
            std::size_t expected = 0;
            for (int z = 0; z < side; ++z) {
                for (int y = 0; y < side; ++y) {
                    for (int x = 0; x < side; ++x) {
                        const int dx = std::abs(x - seed[0]), dy = std::abs(y - seed[1]),
                                  dz = std::abs(z - seed[2]);
                        const bool near = std::max({dx, dy, dz}) <= 1 && dx + dy + dz <= 2;
                        expected += near ? 1 : 0;
                        REQUIRE(grown.has({x, y, z}) == near);
                        if (near) REQUIRE(parents.has({x / 2, y / 2, z / 2}));
                    }
                }
            }
            CHECK(grown.count() == expected);
            CHECK(parents.count() <= 8);
            CHECK_FALSE(grown.has({-1, 0, 0}));
            CHECK_FALSE(grown.has({0, side, 0}));
        }
    }
}
