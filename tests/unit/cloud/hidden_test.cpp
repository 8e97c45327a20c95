// The filters `clusters` and `hidden` on clouds whose crowded and interior points are known.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/cloud/shapes.hpp>

#include "files.hpp"

using dsc::Vec3;
using namespace dsc::cloud;

namespace {

using std::numbers::pi;

/// Points evenly on a sphere, along a spiral.
std::vector<Vec3> sphere(std::size_t count, double radius, const Vec3& centre) {
    const double golden = pi * (3.0 - std::sqrt(5.0));
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
        const double r = std::sqrt(1.0 - z * z), angle = golden * static_cast<double>(i);
        points.emplace_back(centre + radius * Vec3(r * std::cos(angle), r * std::sin(angle), z));
    }
    return points;
}

/// The clouds one after the other; the colour says which one a point is from.
Cloud joined(const std::vector<std::vector<Vec3>>& parts) {
    Cloud cloud;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        cloud.points.insert(cloud.points.end(), parts[k].begin(), parts[k].end());
        cloud.colours.insert(cloud.colours.end(), parts[k].size(),
                             {static_cast<std::uint8_t>(k), 0, 0});
    }
    cloud.source = "parts.xyz";
    return cloud;
}

std::size_t kept_of(const Filtered& result, std::uint8_t part) {
    return static_cast<std::size_t>(std::count_if(result.cloud.colours.begin(),
                                                  result.cloud.colours.end(),
                                                  [&](const auto& c) { return c[0] == part; }));
}

Cloud turned(Cloud cloud, double scale, const Vec3& shift) {
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
    for (Vec3& p : cloud.points) p = scale * (turn * p) + shift;
    return cloud;
}

/// A square lattice of 20 x 20 points one apart.
std::vector<Vec3> lattice() {
    std::vector<Vec3> points;
    for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 20; ++i) points.emplace_back(i, j, 0.0);
    return points;
}

}  // namespace

TEST_CASE("clusters: of points that crowd together the first stays, even ones all stay") {
    const std::vector<Vec3> even = lattice();
    CHECK(remove_clusters(joined({even})).report.removed == 0);
    // Seven more points round every 13th, as on the rim of the thesis' teapot, all within 0.05.
    std::vector<Vec3> crowd;
    dsc::RandomStream random({1, 0, 0, 0});
    for (std::size_t i = 0; i < even.size(); i += 13)
        for (int k = 0; k < 7; ++k)
            crowd.push_back(even[i] + 0.05 * Vec3(std::cos(k), std::sin(k), random.normal() * 0.1));
    for (const Cloud& cloud :
         {joined({even, crowd}), turned(joined({even, crowd}), 1e-3, Vec3(1e3, 0, 7))}) {
        const Filtered result = remove_clusters(cloud);
        CHECK(result.cloud.points ==
              std::vector<Vec3>(cloud.points.begin(), cloud.points.begin() + 400));
        CHECK(kept_of(result, 0) == 400);
        CHECK(result.report.filter == "clusters");
        CHECK(result.report.removed == crowd.size());
    }
    // another one of each stays
    CHECK(remove_clusters(joined({crowd, even})).report.removed == crowd.size());
}

TEST_CASE("clusters: the option is the distance that is close") {
    // The 24 nearest of a lattice point lie within 2 sqrt 2: evenly spread, they would be sqrt(8 pi
    // / 24) = 1.02 apart.
    std::vector<Vec3> pair = lattice();
    pair.push_back(pair[210] + Vec3(0.25, 0, 0));
    CHECK(remove_clusters(joined({pair}), {0.23}).report.removed == 0);
    CHECK(remove_clusters(joined({pair}), {0.27}).report.removed == 1);
}

TEST_CASE(
    "hidden: a sphere inside a sphere goes, in any pose and size, and nothing of the outer one") {
    const Cloud nested =
        joined({sphere(1500, 1.0, Vec3::Zero()), sphere(300, 0.6, Vec3(0.1, 0, 0))});
    for (const Cloud& cloud :
         {nested, turned(nested, 1.0, Vec3::Zero()), turned(nested, 1e-3, Vec3(1e3, 0, 7))}) {
        const Filtered result = remove_hidden(cloud);
        CHECK(kept_of(result, 0) == 1500);
        CHECK(kept_of(result, 1) == 0);
        CHECK(result.report.filter == "hidden");
        CHECK(result.report.removed == 300);
        CHECK(result.cloud.points ==
              std::vector<Vec3>(cloud.points.begin(), cloud.points.begin() + 1500));
    }
}

TEST_CASE("hidden: a ring inside a tube's wall goes, as at the ends of the teapot's spout") {
    // A tube into a sphere that goes on inside it, as Newell's spout does.
    std::vector<Vec3> outside, inside;
    for (int ring = 0; ring <= 20; ++ring) {
        const double x = 0.5 + 0.05 * ring;
        for (int k = 0; k < 24; ++k) {
            const Vec3 p(x, 0.2 * std::cos(2 * pi * k / 24), 0.2 * std::sin(2 * pi * k / 24));
            (p.norm() < 0.85 ? inside : outside).push_back(p);
            if (p.norm() >= 0.85 && p.norm() < 1.0)
                outside.pop_back();  // too close to the wall to say
        }
    }
    std::vector<Vec3> wall = sphere(1500, 1.0, Vec3::Zero());
    wall.erase(
        std::remove_if(wall.begin(), wall.end(),
                       [](const Vec3& p) { return p.x() > 0 && std::hypot(p.y(), p.z()) < 0.2; }),
        wall.end());
    // The far end of the tube is closed.
    for (int k = 0; k < 60; ++k) {
        const double r = 0.19 * std::sqrt((k + 0.5) / 60), angle = 2.4 * k;
        outside.emplace_back(1.5, r * std::cos(angle), r * std::sin(angle));
    }
    REQUIRE(inside.size() > 100);
    const Filtered result = remove_hidden(joined({wall, outside, inside}));
    CHECK(kept_of(result, 0) == wall.size());
    CHECK(kept_of(result, 1) == outside.size());
    CHECK(kept_of(result, 2) == 0);
}

TEST_CASE("hidden: what can be seen stays, from either side and in hollows") {
    std::vector<Vec3> bowl = sphere(1500, 1.0, Vec3::Zero());
    bowl.erase(std::remove_if(bowl.begin(), bowl.end(), [](const Vec3& p) { return p.z() > 0; }),
               bowl.end());
    CHECK(remove_hidden(joined({bowl})).report.removed == 0);
    CHECK(remove_hidden(joined({lattice()})).report.removed == 0);
    CHECK(remove_hidden(joined({sphere(800, 1.0, Vec3::Zero()), sphere(800, 1.0, Vec3(2.3, 0, 0))}))
              .report.removed == 0);
    for (const char* shape : {"torus", "box_tunnel"}) {
        CAPTURE(shape);
        CHECK(remove_hidden(sample_shape(shape, 3000, 1, 0.0, 0.0)).report.removed == 0);
    }
}

TEST_CASE("clusters and hidden keep clouds too small to say") {
    const Cloud one{{{1, 2, 3}}};
    const Cloud equal{std::vector<Vec3>(50, Vec3(1, 2, 3))};
    const Cloud few{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    for (const Cloud* cloud : {&one, &few}) {
        CHECK(remove_clusters(*cloud).report.removed == 0);
        CHECK(remove_hidden(*cloud).report.removed == 0);
    }
    CHECK(remove_clusters(equal).report.kept == 1);
    CHECK(remove_hidden(equal).report.removed == 0);
}

TEST_CASE("clusters and hidden refuse options out of range") {
    const Cloud cloud = joined({lattice()});
    const auto refusal = [](const auto& call) { return test::error_of(call); };
    CHECK(refusal([&] { remove_clusters(cloud, {1.0}); }) ==
          "cloud.option 5: parts.xyz: filter clusters: closer is 1; it must lie between 0 and 1");
    HiddenOptions options;
    options.views = 0;
    CHECK(refusal([&] { remove_hidden(cloud, options); }) ==
          "cloud.option 5: parts.xyz: filter hidden: views is 0; it must lie in [1, 10000]");
    options = {};
    options.radius = 0;
    CHECK(
        refusal([&] { remove_hidden(cloud, options); }) ==
        "cloud.option 5: parts.xyz: filter hidden: radius is 0; it must be above 0 and at most 10");
    options = {};
    options.depth = -1;
    CHECK(
        refusal([&] { remove_hidden(cloud, options); }) ==
        "cloud.option 5: parts.xyz: filter hidden: depth is -1; it must be above 0 and at most 10");
    options = {};
    options.share = 1;
    CHECK(
        refusal([&] { remove_hidden(cloud, options); }) ==
        "cloud.option 5: parts.xyz: filter hidden: share is 1; it must be at least 0 and below 1");
    CHECK(refusal([&] {
              remove_hidden(Cloud{{}, {}, "empty.ply"});
          }) ==
          "cloud.empty 5: empty.ply: filter hidden: the cloud has no points; read another file");
}
