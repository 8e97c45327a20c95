// The nearest points of a view's vertices: those of a search for all, and none is searched for
// twice.
#include "run/nearest_points.hpp"

#include <doctest/doctest.h>

#include <dsc/base/random.hpp>

using namespace dsc;

namespace {

std::vector<Vec3> cloud_points(std::uint64_t seed) {
    RandomStream random(RandomKey{seed, 0, 0, 0});
    std::vector<Vec3> points;
    for (int i = 0; i < 500; ++i)
        points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    return points;
}

void check_all(const run::NearestPoints& nearest, const surface::SurfaceView& view,
               const cloud::NearestSearch& search) {
    REQUIRE(nearest.all().size() == view.vertex_count());
    for (std::size_t v = 0; v < view.vertex_count(); ++v) {
        CHECK(nearest.all()[v].index == search.nearest(view.positions[v]).index);
        CHECK(nearest.all()[v].distance == search.nearest(view.positions[v]).distance);
    }
}

}  // namespace

TEST_CASE(
    "after moves, births and deaths of vertices the nearest points are those of a search for all") {
    const std::vector<Vec3> points = cloud_points(1);
    const cloud::NearestSearch search(points);
    RandomStream random(RandomKey{2, 0, 0, 0});
    run::NearestPoints nearest;
    surface::SurfaceView view;
    std::uint32_t next_birth = 0;
    Workers two(2);
    for (int round = 0; round < 12; ++round) {
        surface::SurfaceView next;
        const auto add = [&next](std::uint32_t birth, const Vec3& position) {
            next.births.push_back(birth);
            next.positions.push_back(position);
            next.vertex_ids.push_back(static_cast<mesh::VertexId>(next.vertex_ids.size()));
        };
        const Vec3 shift(0.1, -0.2, 0.05);
        for (std::size_t v = 0; v < view.vertex_count(); ++v) {
            const double fate = random.uniform(0, 1);
            if (fate < 0.2) continue;
            add(view.births[v], fate < 0.4 ? Vec3(view.positions[v] + shift) : view.positions[v]);
        }
        for (int k = 0; k < 60; ++k)
            add(next_birth++,
                Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
        view = next;
        nearest.refresh(view, search, round % 2 == 0 ? nullptr : &two);
        check_all(nearest, view, search);
    }
}

TEST_CASE("a vertex that has not moved keeps its point without a search, one that has moved is "
          "searched for") {
    const std::vector<Vec3> points = cloud_points(3), others = cloud_points(4);
    const cloud::NearestSearch first(points), second(others);
    surface::SurfaceView view;
    view.vertex_ids = {0, 1, 2};
    view.births = {5, 6, 9};
    view.positions = {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0)};
    run::NearestPoints nearest;
    nearest.refresh(view, first, nullptr);
    view.positions[1] = Vec3(-0.5, 0, 0);
    // Another cloud shows which vertices are asked for.
    nearest.refresh(view, second, nullptr);
    CHECK(nearest.all()[0].distance == first.nearest(view.positions[0]).distance);
    CHECK(nearest.all()[1].distance == second.nearest(view.positions[1]).distance);
    CHECK(nearest.all()[2].distance == first.nearest(view.positions[2]).distance);
}
