// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/sdk/filters.hpp>

namespace {

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::Filtered;
using dsc::config::ConfigNode;

Filtered filtered(const Cloud& cloud, const ConfigNode& params = ConfigNode::map()) {
    return dsc::sdk::filtered(DSC_TEST_PLUGIN, "radius_outliers", cloud, params);
}

/// The grid and two points far above it, one of them first.
Cloud with_outliers() {
    Cloud cloud = dsc::sdk::square_grid(12);
    cloud.points.insert(cloud.points.begin(), Vec3(5, 5, 40));
    cloud.confidence.insert(cloud.confidence.begin(), 1.0);
    cloud.points.emplace_back(5, 5, 60);
    cloud.confidence.push_back(1.0);
    return cloud;
}

}  // namespace

TEST_CASE("points far from all others go, the rest keep their attributes") {
    const Filtered result =
        filtered(with_outliers(), ConfigNode::map({{"radius", 0.05}, {"neighbours", 2}}));
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
