// Tests of the filter on a cloud with a known result; the plugin is loaded as in a run.
#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>

namespace {

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::Filtered;
using dsc::config::ConfigNode;

Filtered filtered(const Cloud& cloud, double floor, double ceiling) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto params = ConfigNode::map({{"floor", floor}, {"ceiling", ceiling}});
    return host.create<dsc::hooks::CloudFilter>({"@NAME@", params}, "input.cloud.filters.0")
        ->apply(cloud, {});
}

// Eleven points above each other; the confidence of each is its height.
Cloud pole() {
    Cloud cloud;
    for (int i = 0; i <= 10; ++i) {
        cloud.points.emplace_back(3, 4, 100 + 2 * i);
        cloud.confidence.push_back(0.1 * i);
    }
    return cloud;
}

}  // namespace

TEST_CASE("points at the floor and above the ceiling are removed and counted") {
    const Filtered result = filtered(pole(), 0.25, 0.85);
    REQUIRE(result.cloud.points.size() == 6);
    CHECK(result.cloud.points.front() == Vec3(3, 4, 106));
    CHECK(result.cloud.points.back() == Vec3(3, 4, 116));
    REQUIRE(result.report.reasons.size() == 2);
    CHECK(result.report.reasons[0].count == 3);
    CHECK(result.report.reasons[1].count == 2);
}

TEST_CASE("points keep the attributes from earlier filters") {
    const Filtered result = filtered(pole(), 0.25, 0.85);
    REQUIRE(result.cloud.confidence.size() == 6);
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(result.cloud.confidence[i] == pole().confidence[i + 3]);
}

TEST_CASE("a filter that would remove all points is an error") {
    CHECK_THROWS_AS(filtered(pole(), 0.01, 0.02), dsc::GeometryError);
    CHECK_THROWS_AS(filtered(pole(), 0.8, 0.2), dsc::ConfigError);
}
