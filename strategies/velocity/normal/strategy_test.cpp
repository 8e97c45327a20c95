// Tests of the velocity on surfaces with known values; the plugin is loaded as in a run.
#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

struct Bench {
    Bench() { host.load(DSC_TEST_PLUGIN); }
    std::unique_ptr<dsc::hooks::VelocityField> make(double speed) const {
        return host.create<dsc::hooks::VelocityField>(
            {"normal", ConfigNode::map({{"speed", speed}})}, "velocity");
    }
    dsc::host::Host host;
};

}  // namespace

TEST_CASE("a sphere grows by the speed and shrinks by a negative one") {
    const Bench bench;
    for (const double speed : {0.02, -0.05}) {
        const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(4, 0.8));
        const auto out = dsc::sdk::displacements(*bench.make(speed), dsc::sdk::step_context(view));
        for (std::size_t i = 0; i < out.size(); ++i) {
            CHECK(out[i].norm() == doctest::Approx(std::abs(speed)).epsilon(1e-12));
            CHECK((view.positions[i] + out[i]).norm() ==
                  doctest::Approx(0.8 + speed).epsilon(1e-4));
        }
    }
}

TEST_CASE("a vertex whose normals cancel and one that cannot move stay") {
    const Bench bench;
    auto view = dsc::sdk::view_of(dsc::sdk::square(2, 1.0));
    view.movable[0] = 0;
    view.normals[4] = Vec3::Zero();
    const auto out = dsc::sdk::displacements(*bench.make(0.1), dsc::sdk::step_context(view));
    CHECK(out[0] == Vec3::Zero());
    CHECK(out[4] == Vec3::Zero());
    CHECK((out[1] - Vec3(0, 0, 0.1)).norm() < 1e-15);
}

TEST_CASE("samples are along the given normal") {
    const Bench bench;
    const auto field = bench.make(-0.25);
    REQUIRE(field->can_sample());
    const auto view = dsc::sdk::view_of(dsc::sdk::square(1, 1.0));
    field->prepare(dsc::sdk::step_context(view));
    const std::vector<Vec3> points(1, Vec3(3, 2, 1));
    const std::vector<Vec3> normals(1, Vec3(0, 1, 0));
    std::vector<Vec3> out(1);
    field->sample(points, normals, out);
    CHECK(out[0] == Vec3(0, -0.25, 0));
}
