#include "sizing.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using namespace dsc::remesh;

constexpr double pi = 3.14159265358979323846;

// Points on a sphere, evenly spread except for `squeeze`, which moves them towards the north pole.
void add_sphere(std::size_t count, double squeeze, double radius, dsc::cloud::Normalized& points) {
    for (std::size_t i = 0; i < count; ++i) {
        const double t = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        const double z = 1.0 - 2.0 * std::pow(t, squeeze), r = std::sqrt(1.0 - z * z),
                     angle = 2.399963229728653 * static_cast<double>(i);
        points.points.push_back(radius * Vec3(r * std::cos(angle), r * std::sin(angle), z));
    }
}

dsc::cloud::TargetCloud sphere(std::size_t count, double squeeze = 1.0) {
    dsc::cloud::Normalized points;
    add_sphere(count, squeeze, 1.0, points);
    return dsc::cloud::TargetCloud(points);
}

// The surface of a wall between two spheres.
dsc::surface::TriangleMesh hollow_ball(double inner) {
    dsc::surface::TriangleMesh wall = dsc::sdk::icosphere(5, 1.0);
    const dsc::surface::TriangleMesh inside = dsc::sdk::icosphere(5, inner);
    const auto first = static_cast<std::uint32_t>(wall.points.size());
    wall.points.insert(wall.points.end(), inside.points.begin(), inside.points.end());
    for (const auto& [a, b, c] : inside.faces)
        wall.faces.push_back({first + a, first + c, first + b});
    return wall;
}

struct SizingStart {
    explicit SizingStart(const dsc::surface::TriangleMesh& triangles)
        : view(dsc::sdk::view_of(triangles)) {
        mesh.build(view);
    }
    SizingStart(const SizingStart&) = delete;
    SizingStart& operator=(const SizingStart&) = delete;
    dsc::hooks::StepContext context(const dsc::cloud::TargetCloud* cloud) const {
        return {.surface = view,
                .cloud = cloud,
                .target_length = 0.123,
                .box = {},
                .to_normalised = {}};
    }
    double vertices(const Lengths& lengths) const {
        double sum = 0.0;
        for (std::size_t f = 0; f < view.face_count(); ++f) {
            for (const std::uint32_t v : view.faces[f])
                sum += view.face_areas[f] / 3.0 / (lengths.at(v) * lengths.at(v));
        }
        return 2.0 / std::sqrt(3.0) * sum;
    }
    dsc::surface::SurfaceView view;
    EdgeMesh mesh;
};

}  // namespace

TEST_CASE("an even cloud gives one length, from the area and the number of its points") {
    const auto cloud = sphere(4000);
    const SizingStart s(dsc::sdk::icosphere(4, 1.0));
    Sizing sizing;
    const Lengths lengths = sizing.lengths(s.context(&cloud), s.mesh, {}, 1.0);
    CHECK(lengths.each.empty());
    // The budget is 6,000 vertices for 3,000 points and 20,000 for 20,000 points, so it is 6,824
    // for 4,000 points.
    const double budget = dsc::cloud::vertex_budget(4000);
    CHECK(lengths.everywhere ==
          doctest::Approx(std::sqrt(1.1547 * 4 * pi / (0.95 * budget))).epsilon(0.05));
    CHECK(s.vertices(lengths) == doctest::Approx(0.95 * budget).epsilon(0.08));
    CHECK(sizing.lengths(s.context(&cloud), s.mesh, {}, 1.02).everywhere ==
          doctest::Approx(1.02 * lengths.everywhere));
    CHECK(sizing.lengths(s.context(&cloud), s.mesh, {1000, 0.0, true}, 1.0).everywhere ==
          doctest::Approx(lengths.everywhere * std::sqrt(budget / 1000)));
    CHECK(sizing.lengths(s.context(&cloud), s.mesh, {1000, 0.2, true}, 1.0).everywhere == 0.2);
}

TEST_CASE("without a cloud the area of the interface is used, and without a wish nothing changes") {
    const SizingStart s(dsc::sdk::icosphere(4, 1.0));
    Sizing sizing;
    CHECK(sizing.lengths(s.context(nullptr), s.mesh, {}, 1.0).everywhere == 0.123);
    const Lengths lengths = sizing.lengths(s.context(nullptr), s.mesh, {2000, 0.0, true}, 1.0);
    CHECK(s.vertices(lengths) == doctest::Approx(1900).epsilon(1e-4));
}

TEST_CASE("noise makes edges longer, with a dead zone where the spacing is even") {
    const auto of = [](double ratio, double spread) {
        dsc::cloud::Statistics statistics;
        statistics.noise_ratio = ratio;
        statistics.spread = spread;
        return noise_factor(statistics);
    };
    CHECK(of(0.0, 1.5) == 1.0);
    CHECK(of(0.12, 1.5) == 1.0);
    CHECK(of(0.21, 1.5) == doctest::Approx(1.0 + 1.5 * 0.15));
    CHECK(of(0.3, 1.5) == doctest::Approx(1.45));
    CHECK(of(0.299999, 1.5) == doctest::Approx(1.45).epsilon(1e-4));
    CHECK(of(0.1, 3.5) == doctest::Approx(1.15));
    CHECK(of(5.0, 1.5) == 2.0);
}

TEST_CASE("an uneven cloud gives lengths that follow it, graded, for the same number of vertices") {
    const auto cloud = sphere(4000, 3.0);
    REQUIRE(cloud.statistics().spread >= 3.0);
    const SizingStart s(dsc::sdk::icosphere(5, 1.0));
    Sizing sizing;
    const Lengths lengths = sizing.lengths(s.context(&cloud), s.mesh, {}, 1.0);
    REQUIRE(lengths.each.size() == s.view.vertex_count());
    const double factor = noise_factor(cloud.statistics());
    CHECK(s.vertices(lengths) * factor * factor ==
          doctest::Approx(0.95 * dsc::cloud::vertex_budget(4000)).epsilon(1e-6));
    double north = 0.0, south = 0.0;
    std::size_t steep = 0;
    for (std::uint32_t v = 0; v < s.view.vertex_count(); ++v) {
        if (s.view.positions[v].z() > 0.9) north = std::max(north, lengths.at(v));
        if (s.view.positions[v].z() < -0.5) south = std::max(south, lengths.at(v));
    }
    CHECK(south > 2.0 * north);
    for (std::size_t e = 0; e < s.mesh.edges.size(); ++e) {
        const auto& [a, b] = s.mesh.edges[e].vertices;
        steep += std::abs(lengths.at(a) - lengths.at(b)) > 0.32 * s.mesh.lengths[e] ? 1 : 0;
    }
    CHECK(steep == 0);
}

TEST_CASE("a thin wall gets edges of half its thickness, within one and a half times the budget") {
    // Points are 0.057 apart, and the usual edges have this length: a wall of 0.2 is not thin, one
    // of 0.1 is. A wall of 0.04 would need too many vertices.
    for (const double inner : {0.8, 0.9, 0.96}) {
        CAPTURE(inner);
        dsc::cloud::Normalized points;
        for (const double radius : {1.0, inner}) add_sphere(4000, 1.0, radius, points);
        const dsc::cloud::TargetCloud cloud(points);
        const SizingStart s(hollow_ball(inner));
        Sizing sizing;
        const double usual = sizing.lengths(s.context(&cloud), s.mesh, {0, 0.0, false}, 1.0).at(0);
        CHECK(sizing.allowance() == 1.0);
        const Lengths lengths = sizing.lengths(s.context(&cloud), s.mesh, {}, 1.0);
        const double wall = 1.0 - inner;
        if (wall > 2.0 * usual) {
            CHECK(lengths.each.empty());
            CHECK(sizing.allowance() == 1.0);
            continue;
        }
        REQUIRE(lengths.each.size() == s.view.vertex_count());
        CHECK(sizing.allowance() > 1.0);
        CHECK(sizing.allowance() <= 1.5);
        const double shortened = usual / std::sqrt(sizing.allowance());
        for (const double l : lengths.each) CHECK(l == doctest::Approx(shortened).epsilon(0.05));
        if (usual * usual < 1.5 * 0.25 * wall * wall)
            CHECK(shortened == doctest::Approx(0.5 * wall).epsilon(0.03));
        CHECK(shortened >= 0.5 * wall * 0.97);
    }
}
