#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/base/random.hpp>
#include <dsc/cloud/filter.hpp>

#include "solids.hpp"

using dsc::Vec3;
using namespace dsc::cloud;
using namespace dsc::cloud::known;

namespace {

Cloud cloud_of(std::vector<Vec3> points) {
    Cloud cloud;
    cloud.points = std::move(points);
    return cloud;
}

std::size_t count_of(const Filtered& result, std::size_t reason) {
    return result.report.reasons[reason].count;
}

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
    for (std::size_t few = 1; few < 12; ++few)
        CHECK(remove_outliers(cloud_of(sphere(few).points)).report.removed == 0);
}

TEST_CASE("outliers: most of those spread through the box go, no other point does") {
    Cloud cloud = cloud_of(torus(5000).points);
    dsc::RandomStream random({6, 0, 0, 0});
    for (int i = 0; i < 100; ++i)
        cloud.points.emplace_back(4.0 * random.uniform() - 2.0, 4.0 * random.uniform() - 2.0,
                                  4.0 * random.uniform() - 2.0);
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
        cloud.confidence.push_back(static_cast<double>(i));
    const Filtered result = remove_outliers(cloud);
    CHECK(result.report.removed > 85);
    CHECK(result.report.kept + result.report.removed == cloud.points.size());
    std::size_t counted = 0;
    for (const RemovedPoints& reason : result.report.reasons) counted += reason.count;
    CHECK(counted == result.report.removed);
    CHECK(count_of(result, 0) > 0);
    for (std::size_t i = 0; i < 5000; ++i)
        CHECK(result.cloud.confidence[i] == static_cast<double>(i));
    for (const unsigned threads : {2U, 3U}) {
        dsc::Workers workers(threads);
        CHECK(remove_outliers(cloud, {}, &workers).cloud.points == result.cloud.points);
    }
}

TEST_CASE("outliers: options and reasons") {
    Cloud cloud = cloud_of(sphere(2000).points);
    for (const Vec3& p : sphere(20).points)
        cloud.points.push_back(Vec3(0, 0, 6) + 1.5 * p);  // far together, none alone
    const Filtered result = remove_outliers(cloud);
    CHECK(result.report.removed == 20);
    CHECK(result.report.reasons[1].reason == "far");
    CHECK(count_of(result, 1) == 20);
    CHECK(remove_outliers(cloud, {2.5, 1000.0, 0.2, 1.0}).report.removed == 0);
    CHECK(remove_outliers(cloud, {2.5, 8.0, 0.005}).report.removed == 0);  // too many, so none
    CHECK_THROWS_AS(remove_outliers(cloud, {0.5, 8.0, 0.2}), dsc::GeometryError);
    CHECK_THROWS_AS(remove_outliers(cloud, {2.5, 0.0, 0.2}), dsc::GeometryError);
    CHECK_THROWS_AS(remove_outliers(cloud, {2.5, 8.0, 1.0}), dsc::GeometryError);
    CHECK_THROWS_AS(remove_outliers(cloud, {2.5, 8.0, 0.2, 1.5}), dsc::GeometryError);
    CHECK_THROWS_AS(remove_outliers(Cloud{}), dsc::GeometryError);
}

TEST_CASE("outliers: of a tenth and a fifth more points in the box nearly all that lie away from "
          "the surface go") {
    for (const std::size_t more : {500UL, 1000UL}) {
        const std::size_t clean = 5000;
        std::vector<Vec3> points = torus(clean).points;
        const dsc::Box3 box = dsc::bounding_box(points);
        dsc::RandomStream random({7, more, 0, 0});
        for (std::size_t i = 0; i < more; ++i) {
            const Vec3 part(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
            points.push_back(box.centre() + 1.2 * part.cwiseProduct(box.size()));
        }
        Cloud cloud = cloud_of(points);
        for (std::size_t i = 0; i < points.size(); ++i)
            cloud.confidence.push_back(static_cast<double>(i));
        const Filtered result = remove_outliers(cloud);
        const auto is_clean = [&](double index) { return index < static_cast<double>(clean); };
        const auto kept = static_cast<std::size_t>(std::count_if(
            result.cloud.confidence.begin(), result.cloud.confidence.end(), is_clean));
        CHECK(clean - kept <= 5);
        std::size_t away = 0;  // 3 % of the diagonal from all points of the torus: two spacings
        for (std::size_t n = kept; n < result.cloud.points.size(); ++n) {
            double nearest = 1e9;
            for (std::size_t i = 0; i < clean; ++i)
                nearest = std::min(nearest, (points[i] - result.cloud.points[n]).norm());
            away += nearest > 0.03 * box.diagonal();
        }
        CHECK(away <= more / 100);
        // The search without the rounds leaves most.
        OutliersOptions once;
        once.dirty = 1.0;
        CHECK(remove_outliers(cloud, once).report.removed < more / 2);
        // The order of the points changes nothing.
        Cloud turned = cloud_of({points.rbegin(), points.rend()});
        std::vector<Vec3> same = remove_outliers(turned).cloud.points;
        std::reverse(same.begin(), same.end());
        CHECK(same == result.cloud.points);
        dsc::Workers workers(3);
        CHECK(remove_outliers(cloud, {}, &workers).cloud.points == result.cloud.points);
    }
}

TEST_CASE("outliers: clumps that fill space go, a small surface of its own stays") {
    std::vector<Vec3> points = torus(10000).points;
    const std::size_t clean = points.size() + 150;
    for (const Vec3& p : sphere(150).points) points.push_back(Vec3(0, 0, 3) + 0.15 * p);
    dsc::RandomStream random({8, 0, 0, 0});
    for (const Vec3& centre : {Vec3(3, 0, 2), Vec3(-3, 1, 2), Vec3(0, 4, -2)})
        for (int i = 0; i < 150; ++i)
            points.push_back(centre +
                             0.12 * Vec3(random.normal(), random.normal(), random.normal()));
    Cloud cloud = cloud_of(points);
    for (std::size_t i = 0; i < points.size(); ++i)
        cloud.confidence.push_back(static_cast<double>(i));
    const Filtered result = remove_outliers(cloud);
    const auto is_clean = [&](double index) { return index < static_cast<double>(clean); };
    const auto kept = static_cast<std::size_t>(
        std::count_if(result.cloud.confidence.begin(), result.cloud.confidence.end(), is_clean));
    CHECK(kept == clean);
    CHECK(result.cloud.points.size() - kept <= 20);  // a group that happens to be flat may stay
    CHECK(result.report.reasons[4].reason == "clump");
    CHECK(count_of(result, 4) > 0);
}

TEST_CASE("outliers: a surface that thins out keeps its points") {
    // Ten times as dense on one side as on the other.
    dsc::RandomStream random({9, 0, 0, 0});
    std::vector<Vec3> points;
    for (const Vec3& p : sphere(12000).points)
        if (random.uniform() < 0.55 - 0.45 * p.x()) points.push_back(p);
    CHECK(remove_outliers(cloud_of(points)).report.removed == 0);
}

TEST_CASE("outliers: where most points repeat others, none goes") {
    Cloud cloud = cloud_of(std::vector<Vec3>(500, Vec3::Zero()));
    cloud.points.emplace_back(1, 0, 0);
    CHECK(remove_outliers(cloud).report.removed == 0);
}
