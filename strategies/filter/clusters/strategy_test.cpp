#include "strategy.hpp"

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>

namespace {

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::Filtered;
using dsc::config::ConfigNode;

Filtered filtered(const Cloud& cloud, const ConfigNode& params = ConfigNode::map()) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    return host.create<dsc::hooks::CloudFilter>({"clusters", params}, "input.cloud.filters.0")->apply(cloud, {});
}


/// The corners of a square grid of side 1 in the plane z = 0; each point has its index as confidence, in hundredths.
Cloud grid(int side) {
    Cloud cloud;
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) {
            cloud.confidence.push_back(0.001 * static_cast<double>(cloud.points.size()));
            cloud.points.emplace_back(i, j, 0);
        }
    }
    return cloud;
}

/// The grid with a second point close beside every fifth one.
Cloud crowded() {
    Cloud cloud = grid(12);
    for (std::size_t i = 0; i < 144; i += 5) {
        cloud.points.push_back(cloud.points[i] + Vec3(0.05, 0, 0));
        cloud.confidence.push_back(1.0);
    }
    return cloud;
}

}  // namespace

TEST_CASE("of points that crowd together the first stays, evenly spread ones all do") {
    const Filtered result = filtered(crowded());
    CHECK(result.cloud.points == grid(12).points);
    CHECK(result.cloud.confidence == grid(12).confidence);
    CHECK(result.report.removed == 29);
    CHECK(filtered(grid(12)).report.removed == 0);
}

TEST_CASE("the wider the distance that counts as close, the more go") {
    CHECK(filtered(crowded(), ConfigNode::map({{"closer", 0.01}})).report.removed == 0);
    // In the grid the 24th neighbour is 2 sqrt 2 away: evenly spread, so many points would be 1.02 apart. They are 1 apart.
    CHECK(filtered(grid(12), ConfigNode::map({{"closer", 0.5}})).report.removed == 0);
    CHECK(filtered(grid(12), ConfigNode::map({{"closer", 0.99}})).report.removed > 0);
}
