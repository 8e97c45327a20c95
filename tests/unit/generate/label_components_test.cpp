#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/generate/label_components.hpp>
#include <dsc/generate/topology_filter.hpp>

#include "implicit.hpp"

using namespace dsc;
using namespace dsc::mesh;
using namespace dsc::generate;
using namespace dsc::generate::implicit;

namespace {

constexpr double pi = 3.14159265358979, cell = 0.06;

double volume_of_ball(double radius) { return 4.0 / 3 * pi * radius * radius * radius; }

Sampled solid(const Function& distance, double scale = 0.1) {
    return sample(cell, distance, [&](const Vec3& x) { return clipped(distance(x) / scale); });
}

// Points on a sphere in a spiral.
std::vector<Vec3> on_sphere(const Vec3& centre, double radius, int count) {
    std::vector<Vec3> out;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), turn = 2.399963 * i;
        out.push_back(centre + radius * Vec3(r * std::cos(turn), r * std::sin(turn), z));
    }
    return out;
}

std::vector<LabelComponent> settle(Sampled& s, const std::vector<Vec3>& cloud,
                                   const ComponentOptions& options) {
    std::vector<std::uint32_t> vertices;
    for (const Vec3& x : cloud) vertices.push_back(s.lattice.vertex_near(x));
    return settle_components(s.lattice.points(), s.tets, s.values, s.volumes, {cloud, vertices},
                             options);
}

ComponentOptions with(CavityPolicy policy) {
    ComponentOptions options;
    options.cavities = policy;
    options.width = 0.05;
    return options;
}

const LabelComponent& nearest(const std::vector<LabelComponent>& list, const Vec3& place,
                              bool inside) {
    const auto distance = [&](const LabelComponent& c) {
        return c.inside == inside ? (c.place - place).norm() : 100;
    };
    return *std::min_element(list.begin(), list.end(), [&](const auto& a, const auto& b) {
        return distance(a) < distance(b);
    });
}

}  // namespace

TEST_CASE("islands below the least volume go, the largest component stays, all are listed with "
          "their volumes") {
    const Vec3 far(0, 0.9, 0), mid(0.9, 0, 0);
    const Function balls = [&](const Vec3& x) {
        return std::max({ball(x, Vec3::Zero(), 0.5), ball(x, mid, 0.2), ball(x, far, 0.1)});
    };
    Sampled s = solid(balls);
    const std::vector<double> old = s.values;
    ComponentOptions options = with(CavityPolicy::automatic);
    options.width = std::cbrt(0.5 * (volume_of_ball(0.1) + volume_of_ball(0.2)) / 30);
    const auto list = settle(s, {}, options);
    REQUIRE(list.size() == 3);
    const LabelComponent &large = nearest(list, Vec3::Zero(), true),
                         &middle = nearest(list, mid, true), &small = nearest(list, far, true);
    CHECK(large.volume == doctest::Approx(volume_of_ball(0.5)).epsilon(0.05));
    CHECK(middle.volume == doctest::Approx(volume_of_ball(0.2)).epsilon(0.15));
    CHECK((large.kept && middle.kept));
    CHECK_FALSE(small.kept);
    CHECK((small.place - far).norm() < 0.01);
    CHECK(small.peak > 0.4);
    CHECK(count_topology(s.lattice.points(), s.tets, s.values).components == 2);
    for (std::size_t v = 0; v < old.size(); ++v) {
        const bool in_island = (s.lattice.points()[v] - far).norm() < 0.1;
        if (in_island) {
            REQUIRE(s.values[v] == (old[v] > 0 ? -1e-3 : old[v]));
        } else {
            REQUIRE(s.values[v] == old[v]);
        }
    }

    s.values = old;
    options.width = 10;  // all are small, the largest stays
    settle(s, {}, options);
    CHECK(count_topology(s.lattice.points(), s.tets, s.values).components == 1);
    s.values = old;
    options.remove_islands = false;
    CHECK(settle(s, {}, options).size() == 3);
    CHECK(s.values == old);
}

TEST_CASE(
    "a cavity stays if it is large, certain and has points at its shell, or as the policy says") {
    const Vec3 centre(0.1, 0, 0);
    const Function shell = [&](const Vec3& x) {
        return std::min(ball(x, Vec3::Zero(), 0.9), (x - centre).norm() - 0.4);
    };
    const Sampled start = solid(shell);
    const auto cavities = [&](const std::vector<Vec3>& cloud, const ComponentOptions& options,
                              std::size_t* points = nullptr) {
        Sampled s{GradedLattice({}, {}, ""), start.tets, start.values, start.volumes};
        std::vector<std::uint32_t> vertices;
        for (const Vec3& x : cloud) vertices.push_back(start.lattice.vertex_near(x));
        const auto list = settle_components(start.lattice.points(), s.tets, s.values, s.volumes,
                                            {cloud, vertices}, options);
        REQUIRE(list.size() == 2);
        const LabelComponent& cavity = list[0].inside ? list[1] : list[0];
        CHECK_FALSE(cavity.inside);
        CHECK(cavity.volume == doctest::Approx(volume_of_ball(0.4)).epsilon(0.05));
        CHECK((cavity.place - centre).norm() < 0.01);
        if (points != nullptr) *points = cavity.points;
        const TopologyCounts now = count_topology(start.lattice.points(), s.tets, s.values);
        CHECK(now.components == 1);
        CHECK(now.genus() == 0);
        CHECK((now.cavities == 1) == cavity.kept);
        return now.cavities;
    };
    std::vector<Vec3> cloud = on_sphere(Vec3::Zero(), 0.9, 300);
    std::size_t points = 0;
    CHECK(cavities(cloud, with(CavityPolicy::automatic), &points) == 0);
    CHECK(points == 0);
    for (const Vec3& x : on_sphere(centre, 0.39, 11)) cloud.push_back(x);
    CHECK(cavities(cloud, with(CavityPolicy::automatic), &points) == 0);
    CHECK(points == 11);
    cloud.push_back(centre + Vec3(0.41, 0, 0));
    CHECK(cavities(cloud, with(CavityPolicy::automatic), &points) == 1);
    CHECK(points == 12);
    CHECK(cavities(cloud, with(CavityPolicy::fill)) == 0);
    CHECK(cavities({}, with(CavityPolicy::keep)) == 1);
    ComponentOptions demanding = with(CavityPolicy::automatic);
    demanding.certain = 0.6;
    CHECK(cavities(cloud, demanding) == 0);
    ComponentOptions coarse = with(CavityPolicy::keep);
    coarse.width = 0.3;
    CHECK(cavities(cloud, coarse) == 0);
}

TEST_CASE("in nested shells each cavity is decided by the points at its own shell") {
    // From outside: solid to 1.1, hollow to 0.9, solid to 0.7, hollow to 0.5, a ball of 0.3.
    const Function onion = [](const Vec3& x) {
        const double r = x.norm();
        return std::max({std::min(1.1 - r, r - 0.9), std::min(0.7 - r, r - 0.5), 0.3 - r});
    };
    Sampled s = solid(onion);
    {
        const TopologyCounts c = count_topology(s.lattice.points(), s.tets, s.values);
        CHECK(c.components == 3);
        CHECK(c.cavities == 2);
    }
    // Only the shell at 0.9 has points, that of the inner hollow is at 0.5; those at 0.3 are the
    // ball's own.
    std::vector<Vec3> cloud = on_sphere(Vec3::Zero(), 0.9, 100);
    for (const Vec3& x : on_sphere(Vec3::Zero(), 0.3, 100)) cloud.push_back(x);
    const auto list = settle(s, cloud, with(CavityPolicy::automatic));
    REQUIRE(list.size() == 5);
    const TopologyCounts after = count_topology(s.lattice.points(), s.tets, s.values);
    CHECK(after.cavities == 1);
    CHECK(after.components == 2);
    std::size_t kept = 0, cavities = 0;
    for (const LabelComponent& c : list) {
        if (c.inside) CHECK(c.kept);
        if (c.inside) continue;
        ++cavities;
        if (!c.kept) CHECK(c.points == 0);
        if (c.kept) CHECK(c.points == 100);
        if (c.kept)
            CHECK(c.volume ==
                  doctest::Approx(volume_of_ball(0.9) - volume_of_ball(0.7)).epsilon(0.1));
        kept += c.kept ? 1 : 0;
    }
    CHECK(cavities == 2);
    CHECK(kept == 1);
}

TEST_CASE("an island in a cavity goes first and leaves its room to the cavity") {
    const Function distance = [](const Vec3& x) {
        const double r = x.norm();
        return std::max(std::min(0.9 - r, r - 0.4), 0.15 - r);
    };
    Sampled s = solid(distance);
    ComponentOptions options = with(CavityPolicy::keep);
    options.width = std::cbrt(volume_of_ball(0.25) / 30);
    const auto list = settle(s, {}, options);
    REQUIRE(list.size() == 3);
    CHECK(count_topology(s.lattice.points(), s.tets, s.values).components == 1);
    CHECK(count_topology(s.lattice.points(), s.tets, s.values).cavities == 1);
    CHECK(std::count_if(list.begin(), list.end(), [](const auto& c) { return !c.kept; }) == 1);
}
