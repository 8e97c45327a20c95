#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>
#include <dsc/cloud/shapes.hpp>
#include <dsc/run/coverage.hpp>

using namespace dsc;
using namespace dsc::run;

namespace {

surface::TriangleMesh ball() {
    const cloud::ShapeMesh mesh = cloud::shape_mesh("sphere");
    return {mesh.points, mesh.faces};
}

Coverage coverage_of(const std::vector<Vec3>& points, const std::vector<Vec3>& removed = {},
                     Workers* workers = nullptr) {
    const surface::TriangleMesh surface = ball();
    return measure_coverage(surface, points, surface::cloud_distances(surface, points, workers),
                            cloud::measure_cloud(points, workers), removed, workers);
}

std::vector<Vec3> on_ball(std::size_t n, double radius = 1.0, const Vec3& centre = Vec3::Zero()) {
    std::vector<Vec3> points = cloud::sample_shape("sphere", n, 3).points;
    for (Vec3& p : points) p = radius * p + centre;
    return points;
}

std::vector<std::string> codes(const hooks::Warnings& warnings) {
    std::vector<std::string> all;
    for (const hooks::Warning& w : warnings) all.push_back(w.code);
    return all;
}

}  // namespace

TEST_CASE("points on the surface are explained by it") {
    const Coverage found = coverage_of(on_ball(4000));
    CHECK(found.points == 4000);
    CHECK(found.far_points == 0);
    CHECK(found.groups.empty());
    CHECK(found.unsupported_share == 0.0);
    CHECK(found.largest_distance < 0.01);
    CHECK(found.gaps.size() == ball().points.size());
    CHECK(found.resolution() == doctest::Approx(found.mean_edge / found.width));
    CHECK(warnings_of(found, {}).empty());
}

TEST_CASE("a second body without a surface is named, with its place in the units of the input") {
    std::vector<Vec3> points = on_ball(4000);
    const std::vector<Vec3> second = on_ball(280, 0.1, Vec3(1.7, 0, 0));
    points.insert(points.end(), second.begin(), second.end());
    const Coverage found = coverage_of(points);
    CHECK(found.far_points == 280);
    REQUIRE(found.groups.size() == 1);
    CHECK(found.groups[0].points == 280);
    CHECK((found.groups[0].centre - Vec3(1.7, 0, 0)).norm() < 0.02);
    CHECK(found.groups[0].farthest == doctest::Approx(0.8).epsilon(0.02));
    CHECK(found.largest_distance == doctest::Approx(0.8).epsilon(0.02));
    // Normalised by (input - (10, 0, 0)) * 0.5: the body stands at 13.4 of the input.
    const hooks::Warnings warnings = warnings_of(found, {Vec3(10, 0, 0), 0.5});
    CHECK(codes(warnings) == std::vector<std::string>{"coverage.points", "coverage.missing"});
    CHECK(warnings[1].text.find("280 points around (13.") != std::string::npos);
}

TEST_CASE("points that a filter removed count as a body where they lie together, not where they "
          "are strewn") {
    CHECK(codes(warnings_of(coverage_of(on_ball(4000), on_ball(100, 0.1, Vec3(1.7, 0, 0))), {})) ==
          std::vector<std::string>{"coverage.missing"});
    RandomStream random(RandomKey{1, 0, 0, 0});
    std::vector<Vec3> strewn;
    for (int i = 0; i < 300; ++i)
        strewn.emplace_back(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
    CHECK(warnings_of(coverage_of(on_ball(4000), strewn), {}).empty());
    // So many that most of them have a neighbour near by: still no body.
    for (int i = 0; i < 400; ++i)
        strewn.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Coverage crowded = coverage_of(on_ball(4000), strewn);
    REQUIRE(!crowded.groups.empty());
    CHECK(crowded.groups[0].points > 50);
    CHECK(warnings_of(crowded, {}).empty());
    // A body with a fifteenth of the points per area is one.
    CHECK(codes(warnings_of(coverage_of(on_ball(4000), on_ball(60, 0.5, Vec3(2, 0, 0))), {})) ==
          std::vector<std::string>{"coverage.missing"});
}

TEST_CASE("a surface without points is a guess") {
    std::vector<Vec3> points = on_ball(8000);
    points.erase(
        std::remove_if(points.begin(), points.end(), [](const Vec3& p) { return p.z() < 0.0; }),
        points.end());
    const Coverage found = coverage_of(points);
    CHECK(found.far_points == 0);
    CHECK(found.unsupported_share > 0.4);
    CHECK(found.unsupported_share < 0.5);
    CHECK(codes(warnings_of(found, {})) == std::vector<std::string>{"coverage.unsupported"});
    CHECK(*std::max_element(found.gaps.begin(), found.gaps.end()) > 10.0);
}

TEST_CASE("the number of threads changes nothing") {
    std::vector<Vec3> points = on_ball(3000);
    const std::vector<Vec3> second = on_ball(280, 0.1, Vec3(1.7, 0, 0)),
                            third = on_ball(90, 0.1, Vec3(0, 1.7, 0));
    points.insert(points.end(), second.begin(), second.end());
    Workers workers(3);
    const Coverage one = coverage_of(points, third), three = coverage_of(points, third, &workers);
    CHECK(one.gaps == three.gaps);
    CHECK(one.unsupported_share == three.unsupported_share);
    REQUIRE(one.groups.size() == 2);
    REQUIRE(three.groups.size() == 2);
    CHECK(one.groups[0].centre == three.groups[0].centre);
    CHECK(one.groups[1].farthest == three.groups[1].farthest);
}
