#include <cmath>

#include <doctest/doctest.h>
#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/filter.hpp>

#include "solids.hpp"

using dsc::Vec3;
using namespace dsc::cloud;
using namespace dsc::cloud::test;

namespace {

Cloud cloud_of(std::vector<Vec3> points) {
    Cloud cloud;
    cloud.points = std::move(points);
    return cloud;
}

std::size_t count_of(const Filtered& result, std::size_t reason) { return result.report.reasons[reason].count; }

}  // namespace

TEST_CASE("outliers: clean clouds keep all their points") {
    for (const std::size_t count : {500UL, 5000UL}) {
        for (const Solid& solid : {sphere(count), torus(count), cube(count)}) {
            const Cloud cloud = cloud_of(solid.points);
            const Filtered result = remove_outliers(cloud);
            CHECK(result.cloud.points == cloud.points);
            CHECK(result.report.removed == 0);
        }
    }
    for (std::size_t few = 1; few < 12; ++few) CHECK(remove_outliers(cloud_of(sphere(few).points)).report.removed == 0);
}

TEST_CASE("outliers: most of those spread through the box go, no other point does") {
    Cloud cloud = cloud_of(torus(5000).points);
    dsc::RandomStream random({6, 0, 0, 0});
    for (int i = 0; i < 100; ++i)
        cloud.points.emplace_back(4.0 * random.uniform() - 2.0, 4.0 * random.uniform() - 2.0, 4.0 * random.uniform() - 2.0);
    for (std::size_t i = 0; i < cloud.points.size(); ++i) cloud.confidence.push_back(static_cast<double>(i));
    const Filtered result = remove_outliers(cloud);
    CHECK(result.report.removed > 75);
    CHECK(result.report.kept + result.report.removed == cloud.points.size());
    CHECK(count_of(result, 0) + count_of(result, 1) == result.report.removed);
    CHECK(count_of(result, 0) > 0);
    for (std::size_t i = 0; i < 5000; ++i) CHECK(result.cloud.confidence[i] == static_cast<double>(i));
    for (const unsigned threads : {2U, 3U}) {
        dsc::Workers workers(threads);
        CHECK(remove_outliers(cloud, {}, &workers).cloud.points == result.cloud.points);
    }
}

TEST_CASE("outliers: options and reasons") {
    Cloud cloud = cloud_of(sphere(2000).points);
    for (const Vec3& p : sphere(20).points) cloud.points.push_back(Vec3(0, 0, 6) + 1.5 * p);  // far together, none alone
    const Filtered result = remove_outliers(cloud);
    CHECK(result.report.removed == 20);
    CHECK(result.report.reasons[1].reason == "far");
    CHECK(count_of(result, 1) == 20);
    CHECK(remove_outliers(cloud, {2.5, 1000.0, 0.2}).report.removed == 0);
    CHECK(remove_outliers(cloud, {2.5, 8.0, 0.005}).report.removed == 0);  // too many, so none
    CHECK_THROWS_AS(remove_outliers(cloud, {0.5, 8.0, 0.2}), dsc::GeometryError);
    CHECK_THROWS_AS(remove_outliers(cloud, {2.5, 0.0, 0.2}), dsc::GeometryError);
    CHECK_THROWS_AS(remove_outliers(cloud, {2.5, 8.0, 1.0}), dsc::GeometryError);
    CHECK_THROWS_AS(remove_outliers(Cloud{}), dsc::GeometryError);
}

TEST_CASE("outliers: where most points repeat others, none goes") {
    Cloud cloud = cloud_of(std::vector<Vec3>(500, Vec3::Zero()));
    cloud.points.emplace_back(1, 0, 0);
    CHECK(remove_outliers(cloud).report.removed == 0);
}
