#include "strategy.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <dsc/host/host.hpp>

namespace {

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::Filtered;
using dsc::config::ConfigNode;

Filtered filtered(const Cloud& cloud, const ConfigNode& params = ConfigNode::map()) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    return host.create<dsc::hooks::CloudFilter>({"radius_outliers", params}, "input.cloud.filters.0")->apply(cloud, {});
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

/// The grid and two points far above it, one of them first.
Cloud with_outliers() {
    Cloud cloud = grid(12);
    cloud.points.insert(cloud.points.begin(), Vec3(5, 5, 40));
    cloud.confidence.insert(cloud.confidence.begin(), 1.0);
    cloud.points.emplace_back(5, 5, 60);
    cloud.confidence.push_back(1.0);
    return cloud;
}

}  // namespace

TEST_CASE("points far from all others go, the rest keep their attributes") {
    const Filtered result = filtered(with_outliers(), ConfigNode::map({{"radius", 0.05}, {"neighbours", 2}}));
    CHECK(result.report.filter == "radius_outliers");
    CHECK(result.report.removed == 2);
    CHECK(result.cloud.points == grid(12).points);
    CHECK(result.cloud.confidence == grid(12).confidence);
}

TEST_CASE("parameters are heard") {
    // In the grid a corner has two neighbours at distance 1, an edge point three, any other four.
    const double radius = 1.2 / (11.0 * std::sqrt(2.0));
    const auto kept = [&](int neighbours) {
        return filtered(grid(12), ConfigNode::map({{"radius", radius}, {"neighbours", neighbours}})).report.kept;
    };
    CHECK(kept(2) == 144);
    CHECK(kept(3) == 140);
    CHECK(kept(4) == 100);
}
