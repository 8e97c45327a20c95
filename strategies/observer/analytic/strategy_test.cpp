// Tests of the comparison and of the figures; the plugin is loaded as in a run.
#include <cmath>
#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

#include "comparison.hpp"

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using Table = std::map<std::string, double>;

struct Bench {
    Bench() { host.load(DSC_TEST_PLUGIN); }
    std::unique_ptr<dsc::hooks::Observer> make(const ConfigNode& params) const {
        return host.create<dsc::hooks::Observer>({"analytic", params}, "observers.0");
    }
    dsc::host::Host host;
};

Table table(const dsc::hooks::Figures& figures) { return {figures.begin(), figures.end()}; }

void begin(dsc::hooks::Observer& observer, const dsc::surface::TriangleMesh& mesh) {
    const auto view = dsc::sdk::view_of(mesh);
    observer.begin(dsc::sdk::step_context(view, 0));
}
Table step(dsc::hooks::Observer& observer, const dsc::surface::TriangleMesh& mesh,
           std::uint64_t number) {
    const auto view = dsc::sdk::view_of(mesh);
    return table(observer.step(dsc::sdk::step_context(view, number), {}));
}
Table end(dsc::hooks::Observer& observer, const dsc::surface::TriangleMesh& mesh,
          std::uint64_t number) {
    const auto view = dsc::sdk::view_of(mesh);
    return table(observer.end(dsc::sdk::step_context(view, number)));
}

dsc::surface::TriangleMesh scaled(dsc::surface::TriangleMesh mesh, double factor) {
    return dsc::sdk::moved(std::move(mesh), [factor](const Vec3& p) { return Vec3(factor * p); });
}

// A square prism with two triangles per side, corners at +-1, faces outwards.
dsc::surface::TriangleMesh cube() {
    dsc::surface::TriangleMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

}  // namespace

TEST_CASE(
    "the distance of a cube from a sphere is that of its faces' middles, not of its corners") {
    // The corners are on the sphere of radius sqrt(3), with distance 0; the middles of the faces
    // are sqrt(3) - 1 away.
    const auto found = dsc::strategies::compare_with_sphere(cube(), Vec3::Zero(), std::sqrt(3.0));
    CHECK(found.radius == doctest::Approx(std::sqrt(3.0)));
    CHECK(found.largest_distance == doctest::Approx(std::sqrt(3.0) - 1).epsilon(1e-12));
    // Mean of sqrt(3) - sqrt(1 + x^2 + y^2) over the unit square; the integral of the root
    // is 1.280789.
    CHECK(found.mean_distance == doctest::Approx(std::sqrt(3.0) - 1.280789).epsilon(0.02));
}

TEST_CASE("two parallel squares are as far apart as their planes, from both sides") {
    const auto low = dsc::sdk::square(3, 0.5);
    const auto high = dsc::sdk::moved(low, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.25); });
    CHECK(dsc::strategies::mean_distance(low, high) == doctest::Approx(0.25).epsilon(1e-12));
    // Half of the large square is far from the small one: only the mean in this direction shows it.
    const auto large = dsc::sdk::square(6, 1.0);
    CHECK(dsc::strategies::mean_distance(low, large) > 0.1);
    CHECK(dsc::strategies::mean_distance(low, large) == dsc::strategies::mean_distance(large, low));
}

TEST_CASE("sphere: what is as it should be has no error") {
    const Bench bench;
    const auto observer = bench.make(ConfigNode::map({{"solution", "sphere"}, {"radius", 0.8}}));
    const auto mesh = dsc::sdk::icosphere(3, 0.8);
    begin(*observer, mesh);
    const Table row = step(*observer, mesh, 1);
    CHECK(row.at("volume_drift") < 1e-14);
    CHECK(row.at("vertex_ratio") == 1.0);
    CHECK(row.at("distance_ratio") == doctest::Approx(1.0));
    CHECK(row.at("radius_error") < 1e-13);
    CHECK(row.at("surface_error") < 0.05);
    CHECK(row.at("surface_error") > 0.0);
    CHECK(end(*observer, mesh, 1) == row);
}

TEST_CASE("sphere: each figure shows the error that it is for") {
    const Bench bench;
    const auto observer = bench.make(ConfigNode::map({{"solution", "sphere"}, {"radius", 0.8}}));
    const auto mesh = dsc::sdk::icosphere(3, 0.8);
    begin(*observer, mesh);
    const Table grown = step(*observer, scaled(mesh, 1.01), 1);
    CHECK(grown.at("volume_drift") == doctest::Approx(0.030301).epsilon(1e-9));
    CHECK(grown.at("radius_error") == doctest::Approx(0.01).epsilon(1e-9));
    const Table shrunk = step(*observer, scaled(mesh, 0.99), 2);
    CHECK(shrunk.at("volume_drift") == doctest::Approx(0.029701).epsilon(1e-9));
    CHECK(shrunk.at("distance_ratio") > 2.0);

    // One vertex out of place: the sphere's volume and radius hardly change, the largest distance
    // does.
    auto spiked = mesh;
    spiked.points[5] *= 1.1;
    const Table spike = step(*observer, spiked, 3);
    const double start =
        dsc::strategies::compare_with_sphere(mesh, Vec3::Zero(), 0.8).largest_distance;
    CHECK(spike.at("distance_ratio") == doctest::Approx(0.08 / start).epsilon(1e-6));
    CHECK(spike.at("radius_error") < 0.001);

    CHECK(step(*observer, dsc::sdk::icosphere(2, 0.8), 4).at("vertex_ratio") ==
          doctest::Approx(162.0 / 642));
    // In the summary the radius error is the largest of the run, the other figures are those of the
    // end.
    const Table summary = end(*observer, mesh, 4);
    CHECK(summary.at("radius_error") == doctest::Approx(0.01).epsilon(1e-6));
    CHECK(summary.at("volume_drift") < 1e-14);
}

TEST_CASE("shrinking_sphere: sqrt(r^2 - 4 t), measured down to half the radius") {
    const Bench bench;
    const auto observer = bench.make(
        ConfigNode::map({{"solution", "shrinking_sphere"}, {"radius", 1.0}, {"time_step", 0.01}}));
    const auto mesh = dsc::sdk::icosphere(3, 1.0);
    begin(*observer, mesh);
    for (std::uint64_t n = 1; n <= 18; ++n) {
        const double radius = std::sqrt(1 - 0.04 * static_cast<double>(n));
        const Table row = step(*observer, scaled(mesh, radius), n);
        CHECK(row.at("radius_error") < 1e-13);
        CHECK(row.at("volume_drift") < 1e-13);
    }
    // Below half the radius (step 18.75) a wrong radius no longer counts, and nothing divides by 0.
    CHECK(step(*observer, scaled(mesh, 0.4), 24).at("radius_error") ==
          doctest::Approx(0.4).epsilon(1e-6));
    CHECK(step(*observer, {}, 25).at("radius_error") == 0.0);
    CHECK(end(*observer, {}, 26).at("radius_error") < 1e-13);
}

TEST_CASE("growing_sphere: the radius grows by the same length in every step") {
    const Bench bench;
    const auto observer = bench.make(
        ConfigNode::map({{"solution", "growing_sphere"}, {"radius", 0.5}, {"growth", 0.05}}));
    const auto mesh = dsc::sdk::icosphere(3, 0.5);
    begin(*observer, mesh);
    const Table row = step(*observer, scaled(mesh, 1.4), 4);
    CHECK(row.at("radius_error") < 1e-13);
    CHECK(row.at("volume_drift") < 1e-13);
    CHECK(step(*observer, scaled(mesh, 1.4), 5).at("radius_error") ==
          doctest::Approx(0.05 / 0.75).epsilon(1e-9));
}

TEST_CASE("shrinking_sphere: an interface that vanished too early is wrong") {
    const Bench bench;
    const auto observer = bench.make(
        ConfigNode::map({{"solution", "shrinking_sphere"}, {"radius", 1.0}, {"time_step", 0.01}}));
    begin(*observer, dsc::sdk::icosphere(3, 1.0));
    const Table row = step(*observer, {}, 3);
    CHECK(row.at("radius_error") == 1.0);
    CHECK(row.at("volume_drift") == 1.0);
    CHECK(row.at("distance_ratio") > 1.0);
    CHECK(end(*observer, {}, 3).at("radius_error") == 1.0);
}

TEST_CASE("start: the mean distance from where it began, in L") {
    const Bench bench;
    const auto observer = bench.make(ConfigNode::map({}));
    const auto mesh = dsc::sdk::icosphere(4, 1.0);
    begin(*observer, mesh);
    const Table row = step(*observer, mesh, 1);
    CHECK(row.size() == 2);
    CHECK(row.at("volume_drift") < 1e-14);
    const auto bigger = scaled(mesh, 1.05);
    const double edge = dsc::sdk::view_of(bigger).mean_edge;
    const Table summary = end(*observer, bigger, 2);
    CHECK(summary.at("surface_error") == doctest::Approx(0.05 / edge).epsilon(0.01));
    CHECK(end(*observer, mesh, 2).at("surface_error") < 1e-12);
    CHECK(end(*observer, {}, 2).count("surface_error") == 0);
}

TEST_CASE("a saved observer continues as if it had never stopped") {
    const Bench bench;
    const auto mesh = dsc::sdk::icosphere(2, 1.0);
    for (const char* solution : {"start", "sphere", "shrinking_sphere"}) {
        const auto params = ConfigNode::map({{"solution", solution}});
        const auto first = bench.make(params);
        begin(*first, mesh);
        step(*first, scaled(mesh, 0.97), 1);
        std::stringstream state;
        first->save(state);
        const auto second = bench.make(params);
        second->load(state);
        const auto later = scaled(mesh, 0.98);
        CHECK(step(*first, later, 2) == step(*second, later, 2));
        CHECK(end(*first, later, 2) == end(*second, later, 2));
    }
}

TEST_CASE("a damaged state is refused") {
    const Bench bench;
    const auto observer = bench.make(ConfigNode::map({}));
    begin(*observer, dsc::sdk::icosphere(1, 1.0));
    std::stringstream state;
    observer->save(state);
    const std::string text = state.str();
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{5}, text.size() / 2, text.size() - 4}) {
        std::stringstream cut(text.substr(0, length));
        CHECK_THROWS_AS(bench.make(ConfigNode::map({}))->load(cut), dsc::StrategyError);
    }
}
