#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/filter.hpp>

#include "files.hpp"

using dsc::Vec3;
using namespace dsc::cloud;

namespace {

/// Two blobs and some far points, far from the origin; each has its index as colour.
Cloud scan(std::size_t count, std::uint64_t seed) {
    dsc::RandomStream random({seed, 0, 0, 0});
    Cloud cloud;
    for (std::size_t i = 0; i < count; ++i) {
        const double spread = i % 25 == 3 ? 6.0 : i % 3 == 0 ? 0.3 : 1.0;
        Vec3 p(5e6, -4e6, 0);
        for (int k = 0; k < 3; ++k) p[k] += spread * random.normal();
        cloud.points.push_back(p);
        cloud.colours.push_back(
            {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8U), 0});
    }
    cloud.source = "scan.xyz";
    return cloud;
}

double diagonal(const Cloud& cloud) { return dsc::bounding_box(cloud.points).diagonal(); }

/// The kept points must be those of `keep`, in order, bit for bit, and the report must count them.
void check_kept(const Cloud& cloud, const Filtered& result, const std::vector<bool>& keep,
                const char* name) {
    Cloud expected;
    for (std::size_t i = 0; i < keep.size(); ++i)
        if (keep[i]) {
            expected.points.push_back(cloud.points[i]);
            expected.colours.push_back(cloud.colours[i]);
        }
    CHECK(result.cloud.points == expected.points);
    CHECK(result.cloud.colours == expected.colours);
    CHECK(result.cloud.source == cloud.source);
    CHECK(result.report.filter == name);
    CHECK(result.report.kept == expected.points.size());
    CHECK(result.report.kept + result.report.removed == cloud.points.size());
    CHECK(result.report.removed > 0);
    CHECK(result.report.kept > 0);
}

}  // namespace

TEST_CASE("duplicates: exactly equal points") {
    Cloud cloud = scan(400, 1);
    for (std::size_t i = 0; i < 100; ++i) cloud.points[300 + i] = Vec3(cloud.points[(7 * i) % 150]);
    cloud.points[0].z() = 0.0;
    cloud.points[399] = cloud.points[0];
    cloud.points[399].z() = -0.0;
    cloud.points[1] = cloud.points[2];
    cloud.points[1].x() = std::nextafter(cloud.points[2].x(), 0.0);  // not equal
    std::vector<bool> keep(400, true);
    for (std::size_t i = 0; i < 400; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (cloud.points[i] == cloud.points[j]) keep[i] = false;
    CHECK(keep[2]);
    CHECK_FALSE(keep[399]);
    check_kept(cloud, remove_duplicates(cloud), keep, "duplicates");
}

TEST_CASE("duplicates: within a tolerance of an earlier kept point") {
    const Cloud cloud = scan(500, 2);
    const double tolerance = 0.02;
    std::vector<bool> keep(500, true);
    for (std::size_t i = 0; i < 500; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (keep[j] &&
                (cloud.points[i] - cloud.points[j]).norm() <= tolerance * diagonal(cloud))
                keep[i] = false;
    check_kept(cloud, remove_duplicates(cloud, {tolerance}), keep, "duplicates");
}

TEST_CASE("voxel grid: the point nearest to the centroid of each cell, the first of two as far") {
    const Cloud cloud = scan(600, 3);
    const Vec3 low = dsc::bounding_box(cloud.points).low;
    const double edge = 0.02 * diagonal(cloud);
    std::map<std::array<long, 3>, std::vector<std::size_t>> cells;
    for (std::size_t i = 0; i < 600; ++i) {
        const Vec3 c = ((cloud.points[i] - low) / edge).array().floor();
        cells[{std::lround(c.x()), std::lround(c.y()), std::lround(c.z())}].push_back(i);
    }
    std::vector<bool> keep(600, false);
    std::size_t pairs = 0;
    for (const auto& [cell, members] : cells) {
        Vec3 centroid = Vec3::Zero();
        for (const std::size_t i : members)
            centroid += (cloud.points[i] - low) / static_cast<double>(members.size());
        const auto distance = [&](std::size_t i) {
            return (cloud.points[i] - low - centroid).norm();
        };
        std::size_t best = members.front();
        for (const std::size_t i : members)
            if (distance(i) < distance(best) * (1.0 - 1e-9)) best = i;
        keep[best] = true;
        if (members.size() != 2) continue;
        CHECK(best == members.front());
        ++pairs;
    }
    CHECK(pairs > 10);
    check_kept(cloud, voxel_grid(cloud, {0.02}), keep, "voxel_grid");
    CHECK(voxel_grid(cloud, {1.0}).report.kept == 1);
    // more cells than PCL's own grid can count
    CHECK(voxel_grid(cloud, {1e-9}).report.kept == 600);
}

TEST_CASE("statistical outliers against brute force") {
    const Cloud cloud = scan(500, 4);
    for (const std::size_t k : {std::size_t{1}, std::size_t{8}, std::size_t{30}})
        for (const double deviations : {0.5, 1.0, 3.0}) {
            std::vector<double> mean(500);
            double sum = 0.0, squares = 0.0;
            for (std::size_t i = 0; i < 500; ++i) {
                std::vector<double> distances;
                for (std::size_t j = 0; j < 500; ++j)
                    if (j != i) distances.push_back((cloud.points[i] - cloud.points[j]).norm());
                std::sort(distances.begin(), distances.end());
                for (std::size_t n = 0; n < k; ++n)
                    mean[i] += distances[n] / static_cast<double>(k);
                sum += mean[i];
                squares += mean[i] * mean[i];
            }
            const double limit =
                sum / 500 + deviations * std::sqrt((squares - sum * sum / 500) / 499);
            std::vector<bool> keep(500);
            for (std::size_t i = 0; i < 500; ++i) keep[i] = mean[i] <= limit;
            check_kept(cloud, remove_statistical_outliers(cloud, {k, deviations}), keep,
                       "statistical_outliers");
        }
}

TEST_CASE("radius outliers against brute force") {
    const Cloud cloud = scan(500, 5);
    std::size_t compared = 0;
    for (const std::size_t wanted : {std::size_t{1}, std::size_t{3}, std::size_t{12}})
        for (const double radius : {0.01, 0.03, 0.08}) {
            std::vector<bool> keep(500);
            for (std::size_t i = 0; i < 500; ++i) {
                std::size_t others = 0;
                for (std::size_t j = 0; j < 500; ++j)
                    if (j != i &&
                        (cloud.points[i] - cloud.points[j]).norm() <= radius * diagonal(cloud))
                        ++others;
                keep[i] = others >= wanted;
            }
            if (std::find(keep.begin(), keep.end(), true) == keep.end()) continue;
            check_kept(cloud, remove_radius_outliers(cloud, {radius, wanted}), keep,
                       "radius_outliers");
            ++compared;
        }
    CHECK(compared >= 7);
}

TEST_CASE(
    "filters work on clouds of one point, of equal points and of fewer points than neighbours") {
    const Cloud one{{{1, 2, 3}}};
    const Cloud equal{std::vector<Vec3>(5, Vec3(1, 2, 3))};
    const Cloud few{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    CHECK(remove_duplicates(one).report.kept == 1);
    CHECK(remove_duplicates(equal).report.kept == 1);
    CHECK(remove_duplicates(equal, {0.5}).report.kept == 1);
    CHECK(voxel_grid(one).report.kept == 1);
    CHECK(voxel_grid(equal).report.kept == 1);
    CHECK(remove_statistical_outliers(one).report.kept == 1);
    CHECK(remove_statistical_outliers(equal).report.kept == 5);
    CHECK(remove_statistical_outliers(few).report.kept == 3);
    CHECK(remove_radius_outliers(equal).report.kept == 5);
    CHECK(remove_radius_outliers(few, {1.0, 2}).report.kept == 3);
}

TEST_CASE("filters refuse what they cannot work on") {
    const Cloud cloud = scan(20, 6);
    const Cloud none{{}, {}, "empty.ply"};
    Cloud bad = cloud;
    bad.points[4].y() = std::numeric_limits<double>::quiet_NaN();
    const auto refusal = [](const auto& call) { return test::error_of(call); };
    CHECK(
        refusal([&] { remove_duplicates(none); }) ==
        "cloud.empty 5: empty.ply: filter duplicates: the cloud has no points; read another file");
    CHECK(refusal([&] { voxel_grid(bad); }) ==
          "cloud.non_finite 5: scan.xyz: point 4 has a coordinate that is not finite or above "
          "1e100; remove it");
    CHECK(refusal([&] { remove_duplicates(cloud, {-0.1}); }) ==
          "cloud.option 5: scan.xyz: filter duplicates: tolerance is -0.1; it must lie in [0, 1]");
    CHECK(refusal([&] { voxel_grid(cloud, {0.0}); }) ==
          "cloud.option 5: scan.xyz: filter voxel_grid: size is 0; it must lie in [1e-9, 1]");
    CHECK(refusal([&] {
              remove_statistical_outliers(cloud, {0, 1.0});
          }) == "cloud.option 5: scan.xyz: filter statistical_outliers: neighbours is 0; it must "
                "lie in [1, 1000]");
    CHECK(refusal([&] {
              remove_statistical_outliers(cloud, {4, -1.0});
          }) == "cloud.option 5: scan.xyz: filter statistical_outliers: deviations is -1; it must "
                "be at least 0");
    CHECK(refusal([&] {
              remove_radius_outliers(cloud, {0.0, 1});
          }) == "cloud.option 5: scan.xyz: filter radius_outliers: radius is 0; it must be above 0 "
                "and at most 1");
    CHECK(refusal([&] {
              remove_radius_outliers(cloud, {0.1, 0});
          }) == "cloud.option 5: scan.xyz: filter radius_outliers: neighbours is 0; it must lie in "
                "[1, 1000]");
    CHECK(refusal([&] {
              remove_radius_outliers(cloud, {1e-9, 5});
          }) == "cloud.filtered_out 5: scan.xyz: filter radius_outliers removes all 20 points; "
                "relax its options or leave it out");
}

namespace {

/// `scan` with every attribute, each a function of the point's index.
Cloud attributed(std::size_t count) {
    Cloud cloud = scan(count, 9);
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 0.1 * static_cast<double>(i);
        cloud.normals.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        cloud.areas.emplace_back(static_cast<double>(i), 0.0, 1.0);
        cloud.confidence.push_back(static_cast<double>(i) / static_cast<double>(count));
    }
    cloud.orientation.samples = {{cloud.points[0], Vec3::UnitZ(), 0.5}};
    return cloud;
}

/// Index of a point of the cloud, which has no point twice.
std::size_t index_of(const Cloud& cloud, const Vec3& point) {
    return static_cast<std::size_t>(std::find(cloud.points.begin(), cloud.points.end(), point) -
                                    cloud.points.begin());
}

}  // namespace

TEST_CASE("every filter takes all attributes along, and the orientation goes with the first point "
          "that does") {
    const Cloud cloud = attributed(400);
    const std::vector<Filtered> results = {remove_duplicates(cloud, {0.02}),
                                           remove_duplicates(cloud, {0.02, true}),
                                           voxel_grid(cloud, {0.05}),
                                           remove_statistical_outliers(cloud),
                                           remove_radius_outliers(cloud),
                                           remove_clusters(cloud, {0.9}),
                                           remove_hidden(cloud)};
    for (const Filtered& result : results) {
        CAPTURE(result.report.filter);
        CHECK(result.report.removed > 0);
        const std::size_t kept = result.cloud.points.size();
        REQUIRE(result.cloud.colours.size() == kept);
        REQUIRE(result.cloud.normals.size() == kept);
        REQUIRE(result.cloud.areas.size() == kept);
        REQUIRE(result.cloud.confidence.size() == kept);
        bool all = true;
        for (std::size_t i = 0; i < kept; ++i) {
            const std::size_t from = index_of(cloud, result.cloud.points[i]);
            all = all && result.cloud.colours[i] == cloud.colours[from] &&
                  result.cloud.normals[i] == cloud.normals[from] &&
                  result.cloud.areas[i] == cloud.areas[from] &&
                  result.cloud.confidence[i] == cloud.confidence[from];
        }
        CHECK(all);
        CHECK(result.cloud.orientation.empty());
    }
}

TEST_CASE("an orientation stays with all points in their order, and only then") {
    const Cloud cloud = attributed(50);
    CHECK(remove_duplicates(cloud).cloud.orientation.samples.size() == 1);
    CHECK(remove_duplicates(cloud, {0.0, true}).cloud.orientation.empty());  // in another order
    const Cloud sorted = remove_duplicates(cloud, {0.0, true}).cloud;
    Cloud again = sorted;
    again.orientation = cloud.orientation;
    CHECK(remove_duplicates(again, {0.0, true}).cloud.orientation.samples.size() == 1);
}

TEST_CASE("picked points may come in any order and more than once, but must be there") {
    const Cloud cloud = attributed(10);
    const Cloud picked = pick(cloud, std::vector<std::size_t>{7, 0, 7});
    CHECK(picked.points == std::vector<Vec3>{cloud.points[7], cloud.points[0], cloud.points[7]});
    CHECK(picked.confidence == std::vector<double>{0.7, 0.0, 0.7});
    CHECK(picked.source == "scan.xyz");
    CHECK_THROWS_AS(pick(cloud, std::vector<std::size_t>{10}), std::out_of_range);
    Cloud damaged = cloud;
    damaged.normals.pop_back();
    CHECK(pick(damaged, std::vector<std::size_t>{1}).normals.empty());
}

TEST_CASE("duplicates, sorted: -0 and 0 are one place, and the sign of the one that stays does not "
          "hang on the order") {
    const auto sign_of = [](const std::vector<Vec3>& points) {
        const Filtered result = remove_duplicates(Cloud{points}, {0.0, true});
        REQUIRE(result.cloud.points.size() == 2);
        return std::signbit(result.cloud.points[0].x());
    };
    const Vec3 minus(-0.0, 0, 0), plus(0, 0, 0), other(1, 0, 0);
    CHECK(sign_of({minus, other, plus}));
    CHECK(sign_of({plus, minus, other}));
    CHECK_FALSE(sign_of({plus, plus, other}));
}
