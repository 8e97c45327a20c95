// Tests of the filter on clouds with a known result; the plugin is loaded as in a run.
#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>

#include "../filter_test.hpp"

namespace {

/// 1,000 points on a sphere of radius 1; each has its index as confidence, in thousandths.
Cloud sphere() {
    dsc::RandomStream random(dsc::RandomKey{1, 0, 0, 0});
    Cloud cloud;
    for (int i = 0; i < 1000; ++i) {
        cloud.confidence.push_back(0.001 * i);
        cloud.points.push_back(
            Vec3(random.normal(), random.normal(), random.normal()).normalized());
    }
    return cloud;
}

}  // namespace

TEST_CASE("points far from all others go, the rest keep their attributes") {
    Cloud cloud = sphere();
    cloud.points.emplace_back(3, 0, 0);
    cloud.points.emplace_back(0, 0, 0);
    cloud.confidence.resize(1002, 1.0);
    const Filtered result = filtered(cloud);
    CHECK(result.report.filter == "outliers");
    CHECK(result.report.removed == 2);
    CHECK(result.cloud.points == sphere().points);
    CHECK(result.cloud.confidence == sphere().confidence);
    REQUIRE(result.report.reasons.size() == 5);
    CHECK(result.report.reasons[0].count + result.report.reasons[1].count == 2);
}

TEST_CASE("parameters have an effect") {
    Cloud cloud = sphere();
    cloud.points.emplace_back(3, 0, 0);
    cloud.confidence.push_back(1.0);
    CHECK(filtered(sphere()).report.removed == 0);
    CHECK(filtered(cloud, ConfigNode::map({{"most", 0.0}})).report.removed == 0);
    CHECK(filtered(cloud, ConfigNode::map({{"isolated", 900.0}, {"far", 900.0}})).report.removed ==
          0);
    CHECK(filtered(cloud, ConfigNode::map({{"isolated", 900.0}, {"far", 8.0}})).report.removed ==
          1);
    CHECK_THROWS_AS(filtered(cloud, ConfigNode::map({{"isolated", 0.5}})), dsc::ConfigError);
    dsc::RandomStream random(dsc::RandomKey{2, 0, 0, 0});
    Cloud dirty = sphere();
    for (int i = 0; i < 100; ++i)
        dirty.points.emplace_back(6.0 * random.uniform() - 3.0, 6.0 * random.uniform() - 3.0,
                                  6.0 * random.uniform() - 3.0);
    dirty.confidence.resize(dirty.points.size(), 1.0);
    CHECK(filtered(dirty).report.removed >
          filtered(dirty, ConfigNode::map({{"dirty", 1.0}})).report.removed);
}
