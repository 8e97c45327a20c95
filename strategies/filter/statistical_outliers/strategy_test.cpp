// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include "../filter_test.hpp"

TEST_CASE("points far from all others go, the rest keep their attributes") {
    const Filtered result = filtered(grid_with_outliers());
    CHECK(result.report.filter == "statistical_outliers");
    CHECK(result.report.removed == 2);
    CHECK(result.cloud.points == dsc::sdk::square_grid(12).points);
    CHECK(result.cloud.confidence == dsc::sdk::square_grid(12).confidence);
}

TEST_CASE("parameters have an effect") {
    const auto kept = [&](double deviations) {
        return filtered(grid_with_outliers(),
                        ConfigNode::map({{"neighbours", 8}, {"deviations", deviations}}))
            .report.kept;
    };
    CHECK(kept(2.0) == 144);
    CHECK(kept(1000.0) == 146);
}
