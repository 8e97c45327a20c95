// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include "../filter_test.hpp"

namespace {

/// The grid with a second point close to every fifth one.
Cloud crowded() {
    Cloud cloud = dsc::sdk::square_grid(12);
    for (std::size_t i = 0; i < 144; i += 5) {
        cloud.points.push_back(cloud.points[i] + Vec3(0.05, 0, 0));
        cloud.confidence.push_back(1.0);
    }
    return cloud;
}

}  // namespace

TEST_CASE("of points that crowd together the first stays, evenly spread ones all do") {
    const Filtered result = filtered(crowded());
    CHECK(result.cloud.points == dsc::sdk::square_grid(12).points);
    CHECK(result.cloud.confidence == dsc::sdk::square_grid(12).confidence);
    CHECK(result.report.removed == 29);
    CHECK(filtered(dsc::sdk::square_grid(12)).report.removed == 0);
}

TEST_CASE("the wider the distance that counts as close, the more go") {
    CHECK(filtered(crowded(), ConfigNode::map({{"closer", 0.01}})).report.removed == 0);
    // In the grid the 24th neighbour is 2 sqrt 2 away: 24 evenly spread points would be 1.02 apart.
    // They are 1 apart.
    CHECK(filtered(dsc::sdk::square_grid(12), ConfigNode::map({{"closer", 0.5}})).report.removed ==
          0);
    CHECK(filtered(dsc::sdk::square_grid(12), ConfigNode::map({{"closer", 0.99}})).report.removed >
          0);
}
