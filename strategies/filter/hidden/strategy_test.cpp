// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include <cmath>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>

#include "../filter_test.hpp"

namespace {

/// Points evenly spread over a sphere, along a spiral; their confidence is the number of the
/// sphere.
void add_sphere(Cloud& cloud, int count, double radius, double confidence) {
    const double turn = std::acos(-1.0) * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double r = std::sqrt(1.0 - z * z);
        cloud.points.emplace_back(radius * Vec3(r * std::cos(turn * i), r * std::sin(turn * i), z));
        cloud.confidence.push_back(confidence);
    }
}

Cloud nested() {
    Cloud cloud;
    add_sphere(cloud, 100, 0.4, 0.25);
    add_sphere(cloud, 600, 1.0, 0.75);
    return cloud;
}

}  // namespace

TEST_CASE("a sphere within a sphere is removed, the outer one stays") {
    const Filtered result = filtered(nested());
    CHECK(result.report.kept == 600);
    CHECK(result.report.removed == 100);
    CHECK(result.cloud.confidence == std::vector<double>(600, 0.75));
}

TEST_CASE("a cancelled filter ends") {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    dsc::CancelToken token;
    token.cancel();
    dsc::hooks::FilterContext context;
    context.cancel = &token;
    const auto filter = host.create<dsc::hooks::CloudFilter>({"hidden", ConfigNode::map()},
                                                             "input.cloud.filters.0");
    CHECK_THROWS_AS(filter->apply(nested(), context), dsc::CancelledError);
}
