// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include <cmath>

#include "../filter_test.hpp"

TEST_CASE("points far from all others go, the rest keep their attributes") {
    const Filtered result =
        filtered(grid_with_outliers(), ConfigNode::map({{"radius", 0.05}, {"neighbours", 2}}));
    CHECK(result.report.filter == "radius_outliers");
    CHECK(result.report.removed == 2);
    CHECK(result.cloud.points == dsc::sdk::square_grid(12).points);
    CHECK(result.cloud.confidence == dsc::sdk::square_grid(12).confidence);
}

TEST_CASE("parameters have an effect") {
    // In the grid a corner has two neighbours at distance 1, an edge point three, any other four.
    const double radius = 1.2 / (11.0 * std::sqrt(2.0));
    const auto kept = [&](int neighbours) {
        return filtered(dsc::sdk::square_grid(12),
                        ConfigNode::map({{"radius", radius}, {"neighbours", neighbours}}))
            .report.kept;
    };
    CHECK(kept(2) == 144);
    CHECK(kept(3) == 140);
    CHECK(kept(4) == 100);
}
