// Tests of the fields and of the velocity; the plugin is loaded as in a run.
#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

#include "fields.hpp"

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;
using dsc::strategies::displacement;
using dsc::strategies::Field;
using dsc::strategies::FieldKind;
using dsc::strategies::velocity;

const FieldKind all_kinds[] = {FieldKind::translate, FieldKind::rotate, FieldKind::shear,
                               FieldKind::part, FieldKind::enright};

Field field_of(FieldKind kind) {
    Field field;
    field.kind = kind;
    field.axis = Vec3(2, -1, 1);
    field.across = Vec3(1, 1, -1);
    field.centre = Vec3(0.1, 0.2, -0.1);
    field.speed = 0.7;
    return field;
}

struct Bench {
    Bench() { host.load(DSC_TEST_PLUGIN); }
    std::unique_ptr<dsc::hooks::VelocityField> make(const ConfigNode& params) const {
        return host.create<dsc::hooks::VelocityField>({"flow", params}, "velocity");
    }
    dsc::host::Host host;
};

}  // namespace

TEST_CASE("no field has a divergence") {
    constexpr double h = 1e-5;
    for (const FieldKind kind : all_kinds) {
        const Field field = field_of(kind);
        for (const Vec3& p : {Vec3(0.35, 0.4, 0.3), Vec3(0.1, 0.8, 0.6), Vec3(-0.3, 0.2, 0.9)}) {
            double divergence = 0;
            for (Eigen::Index k = 0; k < 3; ++k) {
                const Vec3 e = h * Vec3::Unit(k);
                divergence +=
                    (velocity(field, p + e, 0.4)[k] - velocity(field, p - e, 0.4)[k]) / (2 * h);
            }
            CHECK(std::abs(divergence) < 1e-8);
        }
    }
}

TEST_CASE("fields with a solution in closed form reach it") {
    const Vec3 x(0.6, -0.3, 0.8);
    Field field;
    field.speed = 0.5;
    CHECK((displacement(field, x, 0, 2, 3) - Vec3(1, 0, 0)).norm() < 1e-14);
    field.kind = FieldKind::shear;
    CHECK((displacement(field, x, 0, 2, 3) - Vec3(-0.3, 0, 0)).norm() < 1e-14);
    field.kind = FieldKind::rotate;
    field.axis = Vec3(0, 0, 5);
    field.speed = 1.5707963267948966;
    CHECK((displacement(field, x, 0, 1, 64) - (Vec3(0.3, 0.6, 0.8) - x)).norm() < 1e-8);
    // part: on the axis sinh(s/w) grows by exp(speed t / w); the cross-section shrinks so that the
    // volume stays constant.
    field.kind = FieldKind::part;
    field.axis = Vec3(1, 0, 0);
    field.speed = 0.4;
    field.width = 0.5;
    const Vec3 end = x + displacement(field, x, 0, 0.9, 64);
    const double s = 0.5 * std::asinh(std::exp(0.4 * 0.9 / 0.5) * std::sinh(0.6 / 0.5));
    CHECK(end.x() == doctest::Approx(s).epsilon(1e-9));
    // ds/ds0, velocities on one streamline
    const double stretch = std::tanh(s / 0.5) / std::tanh(0.6 / 0.5);
    CHECK(end.y() == doctest::Approx(-0.3 / std::sqrt(stretch)).epsilon(1e-8));
}

TEST_CASE("halving the time step makes the error sixteen times smaller") {
    const Field field = field_of(FieldKind::enright);
    const Vec3 x(0.35, 0.42, 0.31);
    const Vec3 exact = displacement(field, x, 0.2, 0.8, 4096);
    const double coarse = (displacement(field, x, 0.2, 0.8, 32) - exact).norm();
    const double fine = (displacement(field, x, 0.2, 0.8, 64) - exact).norm();
    CHECK(coarse / fine > 12);
    CHECK(coarse / fine < 22);
}

TEST_CASE("enright: nothing crosses the cube's walls, and at t = T everything is back") {
    const Field field = field_of(FieldKind::enright);
    CHECK(std::abs(velocity(field, Vec3(1, 0.3, 0.4), 0.1).x()) < 1e-15);
    CHECK(std::abs(velocity(field, Vec3(0.3, 0, 0.4), 0.1).y()) < 1e-15);
    CHECK(velocity(field, Vec3(0.25, 0.25, 0.25), 0.0)
              .isApprox(Vec3(2 * 0.5 * 1 * 1, -0.5, -0.5), 1e-14));
    const Bench bench;
    const auto flow = bench.make(ConfigNode::map({{"field", "enright"}, {"time_step", 0.05}}));
    const auto start = dsc::sdk::moved(
        dsc::sdk::icosphere(2, 0.15), [](const Vec3& p) { return Vec3(p + Vec3::Constant(0.35)); });
    auto mesh = start;
    double farthest = 0;
    for (std::uint64_t step = 1; step <= 60; ++step) {
        const auto view = dsc::sdk::view_of(mesh);
        const auto out = dsc::sdk::displacements(*flow, dsc::sdk::step_context(view, step));
        for (std::size_t i = 0; i < out.size(); ++i) {
            mesh.points[i] += out[i];
            farthest = std::max(farthest, (mesh.points[i] - start.points[i]).norm());
        }
    }
    CHECK(farthest > 0.3);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        CHECK((mesh.points[i] - start.points[i]).norm() < 2e-4);
}

TEST_CASE(
    "time follows from the number of the step: a loaded velocity continues at the right time") {
    const Bench bench;
    const auto params = ConfigNode::map({{"field", "enright"}, {"time_step", 0.1}});
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(1, 0.3));
    const auto first = bench.make(params);
    for (std::uint64_t step = 1; step < 9; ++step)
        dsc::sdk::displacements(*first, dsc::sdk::step_context(view, step));
    std::stringstream state;
    first->save(state);
    const auto second = bench.make(params);
    second->load(state);
    const auto out = dsc::sdk::displacements(*second, dsc::sdk::step_context(view, 9));
    CHECK(out == dsc::sdk::displacements(*first, dsc::sdk::step_context(view, 9)));
    for (std::size_t i = 0; i < out.size(); ++i)
        CHECK(out[i] ==
              displacement(field_of(FieldKind::enright), view.positions[i], 8 * 0.1, 0.1, 1));
    CHECK(out != dsc::sdk::displacements(*second, dsc::sdk::step_context(view, 1)));
}

TEST_CASE("sampling is the displacement of any point") {
    const Bench bench;
    const auto flow = bench.make(ConfigNode::map({{"speed", 2.0}, {"time_step", 0.25}}));
    REQUIRE(flow->can_sample());
    const auto view = dsc::sdk::view_of(dsc::sdk::square(1, 1.0));
    flow->prepare(dsc::sdk::step_context(view));
    const std::vector<Vec3> points(1, Vec3(3, 2, 1));
    const std::vector<Vec3> normals(1, Vec3(0, 1, 0));
    std::vector<Vec3> out(1);
    flow->sample(points, normals, out);
    CHECK((out[0] - Vec3(0.5, 0, 0)).norm() < 1e-15);
}

TEST_CASE("directions that do not define a field are refused") {
    const Bench bench;
    CHECK_THROWS_WITH_AS(bench.make(ConfigNode::map({{"axis", ConfigNode::list({0.0, 0.0, 0.0})}})),
                         doctest::Contains("axis must not be the zero vector"), dsc::ConfigError);
    CHECK_THROWS_WITH_AS(
        bench.make(
            ConfigNode::map({{"field", "shear"}, {"across", ConfigNode::list({1.0, 1.0, 0.0})}})),
        doctest::Contains("across must be perpendicular to axis"), dsc::ConfigError);
}
