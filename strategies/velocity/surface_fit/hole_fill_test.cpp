#include "hole_fill.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/sdk/surfaces.hpp>

using dsc::Vec3;
using namespace dsc::strategies::fit;

namespace {

SurfaceLinks links_of(const dsc::surface::TriangleMesh& mesh) {
    SurfaceLinks links;
    build_links(dsc::sdk::view_of(mesh), links);
    return links;
}

}  // namespace

TEST_CASE("a dented plane becomes flat over its hole, and nothing else moves") {
    const auto flat = dsc::sdk::square(20, 1.0);
    const auto links = links_of(flat);
    std::vector<Vec3> positions = flat.points;
    std::vector<double> gaps(positions.size(), 0.3);
    std::size_t inside = 0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (flat.points[v].norm() > 0.55) continue;
        gaps[v] = 1.5;
        positions[v] += Vec3(0.03 * std::sin(20 * flat.points[v].y()), 0.0,
                             -0.4 * (0.55 - flat.points[v].norm()));
        ++inside;
    }
    const std::vector<Vec3> before = positions;
    CHECK(fill_holes(links, gaps, std::vector<std::uint8_t>(positions.size(), 1), positions) ==
          inside);
    for (std::size_t v = 0; v < positions.size(); ++v)
        CHECK((positions[v] - flat.points[v]).norm() < 1e-10);
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (gaps[v] < 1.0) CHECK(positions[v] == before[v]);
    }
}

TEST_CASE("a cap of a ball that sank returns to the ball") {
    const auto ball = dsc::sdk::icosphere(4, 1.0);
    const auto links = links_of(ball);
    std::vector<Vec3> positions = ball.points;
    std::vector<double> gaps(positions.size(), 0.3);
    double before = 0.0, after = 0.0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (ball.points[v].z() < 0.85) continue;
        gaps[v] = 2.0;
        positions[v].z() = 0.85;  // a flat lid
        before = std::max(before, std::abs(positions[v].norm() - 1.0));
    }
    fill_holes(links, gaps, std::vector<std::uint8_t>(positions.size(), 1), positions);
    for (const Vec3& p : positions) after = std::max(after, std::abs(p.norm() - 1.0));
    CHECK(before == doctest::Approx(0.15).epsilon(0.01));
    CHECK(after < 0.2 * before);
}

TEST_CASE("gaps between points are not holes, fixed vertices stay, and a piece far from all points "
          "stays") {
    auto mesh = dsc::sdk::icosphere(2, 1.0);
    const auto links = links_of(mesh);
    std::vector<Vec3> positions = mesh.points;
    const std::vector<std::uint8_t> movable(positions.size(), 1);
    std::vector<double> gaps(positions.size(), 0.3);
    gaps[50] = 1.2;  // a single vertex
    CHECK(fill_holes(links, gaps, movable, positions) == 0);
    std::fill(gaps.begin(), gaps.end(), 3.0);
    CHECK(fill_holes(links, gaps, movable, positions) == 0);
    CHECK(fill_holes(links, gaps, std::vector<std::uint8_t>(positions.size(), 0), positions) == 0);
    CHECK(positions == mesh.points);
    for (std::size_t v = 0; v < gaps.size(); ++v) gaps[v] = mesh.points[v].z() > 0.7 ? 3.0 : 0.3;
    const auto in_cap = static_cast<std::size_t>(std::count(gaps.begin(), gaps.end(), 3.0));
    const auto top = static_cast<std::size_t>(
        std::max_element(mesh.points.begin(), mesh.points.end(),
                         [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); }) -
        mesh.points.begin());
    std::vector<std::uint8_t> one_fixed = movable;
    one_fixed[top] = 0;
    CHECK(fill_holes(links, gaps, one_fixed, positions) == in_cap - 1);
    CHECK(positions[top] == mesh.points[top]);
    CHECK(positions != mesh.points);
}

TEST_CASE("a side that was not scanned is not a hole") {
    auto mesh = dsc::sdk::icosphere(2, 1.0);
    const auto links = links_of(mesh);
    std::vector<Vec3> positions = mesh.points;
    std::vector<double> gaps;
    for (const Vec3& p : mesh.points) gaps.push_back(p.z() > 0.2 ? 3.0 : 0.3);
    CHECK(fill_holes(links, gaps, std::vector<std::uint8_t>(positions.size(), 1), positions) == 0);
    CHECK(positions == mesh.points);
}
