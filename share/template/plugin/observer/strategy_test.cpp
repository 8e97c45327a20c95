// Tests of the figures on surfaces with known values; the plugin is loaded as in a run.
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using Table = std::map<std::string, double>;

struct Bench {
    Bench() { host.load(DSC_TEST_PLUGIN); }
    std::unique_ptr<dsc::hooks::Observer> make(double narrow = 15.0) const {
        return host.create<dsc::hooks::Observer>({"@NAME@", ConfigNode::map({{"narrow", narrow}})},
                                                 "observers.0");
    }
    dsc::host::Host host;
};

Table step(dsc::hooks::Observer& observer, const dsc::surface::TriangleMesh& mesh) {
    const auto view = dsc::sdk::view_of(mesh);
    const auto figures = observer.step(dsc::sdk::step_context(view), {});
    return {figures.begin(), figures.end()};
}
Table end(dsc::hooks::Observer& observer, const dsc::surface::TriangleMesh& mesh) {
    const auto view = dsc::sdk::view_of(mesh);
    const auto figures = observer.end(dsc::sdk::step_context(view));
    return {figures.begin(), figures.end()};
}

dsc::surface::TriangleMesh stretched(double factor) {
    return dsc::sdk::moved(dsc::sdk::icosphere(3, 0.7),
                           [factor](const Vec3& p) { return Vec3(factor * p.x(), p.y(), p.z()); });
}

}  // namespace

TEST_CASE("a sphere is round, an octahedron less so") {
    const Bench bench;
    const auto observer = bench.make();
    CHECK(step(*observer, stretched(1.0)).at("sphericity") == doctest::Approx(1.0).epsilon(0.01));
    CHECK(step(*observer, stretched(3.0)).at("sphericity") < 0.9);
    dsc::surface::TriangleMesh octahedron;
    octahedron.points = {Vec3(1, 0, 0),  Vec3(0, 1, 0), Vec3(-1, 0, 0),
                         Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)};
    for (std::uint32_t i = 0; i < 4; ++i) {
        octahedron.faces.push_back({i, (i + 1) % 4, 4});
        octahedron.faces.push_back({(i + 1) % 4, i, 5});
    }
    const double exact = std::cbrt(36 * std::numbers::pi * 16 / 9) / (4 * std::sqrt(3.0));
    CHECK(step(*observer, octahedron).at("sphericity") == doctest::Approx(exact));
}

TEST_CASE("narrow faces are those with a small angle") {
    const Bench bench;
    // The least angle of these faces is 45 degrees.
    CHECK(step(*bench.make(40.0), dsc::sdk::square(3, 1.0)).at("narrow_faces") == 0.0);
    CHECK(step(*bench.make(50.0), dsc::sdk::square(3, 1.0)).at("narrow_faces") == 1.0);
}

TEST_CASE("a saved observer continues as if it had never stopped, a damaged state is refused") {
    const Bench bench;
    const auto first = bench.make();
    step(*first, stretched(3.0));
    std::stringstream state;
    first->save(state);
    const auto second = bench.make();
    second->load(state);
    CHECK(end(*second, stretched(1.0)) == end(*first, stretched(1.0)));
    CHECK(end(*second, stretched(1.0)).at("least_sphericity") < 0.9);
    for (const char* damaged : {"", "1 0.5", "2 0.5 end", "x"}) {
        std::stringstream text(damaged);
        CHECK_THROWS_AS(bench.make()->load(text), dsc::StrategyError);
    }
}
