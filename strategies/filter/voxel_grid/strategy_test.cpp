// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include <cmath>

#include "../filter_test.hpp"

TEST_CASE("of each cell the point nearest to the middle of its points stays, with its attributes") {
    Cloud cloud = dsc::sdk::square_grid(9);
    // The box is 8 wide, its diagonal 8 sqrt 2: cells of 2.8, which contain 3 by 3 points.
    const double size = 2.8 / (8.0 * std::sqrt(2.0));
    const Filtered result = filtered(cloud, ConfigNode::map({{"size", size}}));
    std::vector<Vec3> expected;
    for (const double y : {1.0, 4.0, 7.0}) {
        for (const double x : {1.0, 4.0, 7.0}) expected.emplace_back(x, y, 0);
    }
    CHECK(result.cloud.points == expected);
    CHECK(result.report.removed == 72);
    REQUIRE(result.cloud.confidence.size() == 9);
    for (std::size_t i = 0; i < 9; ++i) {
        const double index = expected[i].x() + 9.0 * expected[i].y();
        CHECK(result.cloud.confidence[i] == 0.001 * index);
    }
}
