// Tests of the velocity on surfaces with known values; the plugin is loaded as in a run.

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

struct Bench {
    Bench() { host.load(DSC_TEST_PLUGIN); }
    std::unique_ptr<dsc::hooks::VelocityField> make(const ConfigNode& params) const {
        return host.create<dsc::hooks::VelocityField>({"rotate", params}, "velocity");
    }
    dsc::host::Host host;
};

ConfigNode vector(double x, double y, double z) { return ConfigNode::list({x, y, z}); }

}  // namespace

TEST_CASE("a quarter turn about z takes x to y") {
    const Bench bench;
    const auto field = bench.make(ConfigNode::map({{"degrees", 90.0}}));
    const auto view = dsc::sdk::view_of(dsc::sdk::square(4, 0.5));
    const auto out = dsc::sdk::displacements(*field, dsc::sdk::step_context(view));
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Vec3& p = view.positions[i];
        CHECK((p + out[i] - Vec3(-p.y(), p.x(), p.z())).norm() < 1e-15);
    }
}

TEST_CASE("360 steps of one degree about a tilted axis bring every vertex back") {
    const Bench bench;
    const Vec3 centre(0.2, -0.1, 0.3);
    const auto field = bench.make(ConfigNode::map(
        {{"centre", vector(0.2, -0.1, 0.3)}, {"axis", vector(1, 2, 3)}, {"degrees", 1.0}}));
    const auto start = dsc::sdk::icosphere(2, 0.7);
    auto mesh = start;
    for (int step = 0; step < 360; ++step) {
        const auto view = dsc::sdk::view_of(mesh);
        const auto out = dsc::sdk::displacements(*field, dsc::sdk::step_context(view));
        for (std::size_t i = 0; i < out.size(); ++i) mesh.points[i] += out[i];
        if (step == 179) {
            // Half a turn mirrors the part perpendicular to the axis.
            const Vec3 axis = Vec3(1, 2, 3).normalized();
            for (std::size_t i = 0; i < out.size(); ++i) {
                const Vec3 r = start.points[i] - centre;
                CHECK((mesh.points[i] - (centre + 2 * r.dot(axis) * axis - r)).norm() < 1e-12);
            }
        }
    }
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        CHECK((mesh.points[i] - start.points[i]).norm() < 1e-12);
}

TEST_CASE("small angles keep their digits and the distance from the axis") {
    const Bench bench;
    const auto field = bench.make(ConfigNode::map({{"degrees", 1e-7}}));
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(1, 1.0));
    const auto out = dsc::sdk::displacements(*field, dsc::sdk::step_context(view));
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Vec3& p = view.positions[i];
        const Vec3 tangent = 1e-7 * 3.14159265358979323846 / 180 * Vec3(-p.y(), p.x(), 0);
        CHECK((out[i] - tangent).norm() <= 2e-9 * tangent.norm() + 1e-30);
    }
}

TEST_CASE("sampling is the rotation of any point") {
    const Bench bench;
    const auto field = bench.make(ConfigNode::map({{"degrees", 180.0}}));
    REQUIRE(field->can_sample());
    const auto view = dsc::sdk::view_of(dsc::sdk::square(1, 1.0));
    field->prepare(dsc::sdk::step_context(view));
    const std::vector<Vec3> points = {Vec3(1, 0, 0), Vec3(0.3, -0.2, 0.5)};
    const std::vector<Vec3> normals(2, Vec3(0, 0, 1));
    std::vector<Vec3> out(2);
    field->sample(points, normals, out);
    CHECK((out[0] - Vec3(-2, 0, 0)).norm() < 1e-15);
    CHECK((out[1] - Vec3(-0.6, 0.4, 0)).norm() < 1e-15);
}

TEST_CASE("the answer does not depend on blocks and threads") {
    const Bench bench;
    const auto field = bench.make(ConfigNode::map({{"axis", vector(1, 1, 0)}}));
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(3, 1.0));
    const auto context = dsc::sdk::step_context(view);
    CHECK(dsc::sdk::displacements(*field, context, 1, 1000) ==
          dsc::sdk::displacements(*field, context, 3, 17));
}

TEST_CASE("an axis without direction is refused") {
    const Bench bench;
    CHECK_THROWS_WITH_AS(bench.make(ConfigNode::map({{"axis", vector(0, 0, 0)}})),
                         doctest::Contains("axis must not be the zero vector"), dsc::ConfigError);
}
