// Computations for two tets side by side.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/geometry/tet_pair.hpp>

using namespace dsc;
using namespace dsc::geometry;

TEST_CASE("two tets side by side have the bits of single tets") {
    RandomStream random(RandomKey{31, 0, 0, 0});
    std::size_t flat = 0;
    for (int n = 0; n < 20000; ++n) {
        std::array<std::array<Vec3, 4>, 2> tets;
        const double scale = std::pow(10.0, random.uniform(-9.0, 9.0));
        for (auto& tet : tets) {
            for (Vec3& p : tet)
                p = scale *
                    Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            // Some tets are points, some are flat, and the others are of both signs.
            if (random.index(10) == 0) tet = {tet[0], tet[0], tet[0], tet[0]};
            if (random.index(10) == 0) tet[3] = tet[0] + 0.3 * (tet[1] - tet[0]);
        }
        std::array<TwoVec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = side_by_side(tets[0][k], tets[1][k]);
        const TwoShapes both = tet_shapes(corners);
        for (std::size_t i = 0; i < 2; ++i) {
            const auto& [a, b, c, d] = tets[i];
            const TetShape one = tet_shape(a, b, c, d);
            const auto side = static_cast<Eigen::Index>(i);
            REQUIRE(both.quality[side] == one.quality);
            REQUIRE(both.mean_square[side] == one.mean_square);
            REQUIRE(dot(corners[0], corners[1])[side] == a.dot(b));
            REQUIRE(cross(corners[0], corners[1])[2][side] == a.cross(b)[2]);
            flat += std::abs(one.quality) < 1e-12 ? 1 : 0;
        }
    }
    CHECK(flat > 1000);
}
