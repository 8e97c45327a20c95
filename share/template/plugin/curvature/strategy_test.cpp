// Tests of the curvature on surfaces with known values; the plugin is loaded as in a run.
#include <algorithm>

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

struct Values {
    std::vector<double> scalar;
    std::vector<Vec3> vector;
};

Values evaluate(const dsc::surface::SurfaceView& view, double smallest_circle = 0.5) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto params = ConfigNode::map({{"smallest_circle", smallest_circle}});
    const auto estimator =
        host.create<dsc::hooks::CurvatureEstimator>({"@NAME@", params}, "velocity.curvature");
    const auto context = dsc::sdk::step_context(view);
    estimator->prepare(context);
    Values values{std::vector<double>(view.vertex_count()), std::vector<Vec3>(view.vertex_count())};
    estimator->evaluate({0, view.vertex_count()}, values.scalar, values.vector);
    return values;
}

}  // namespace

TEST_CASE("a sphere of radius r has the curvature 1/r, outwards") {
    for (const double radius : {0.3, 1.2}) {
        const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(3, radius));
        const Values values = evaluate(view);
        for (std::size_t v = 0; v < view.vertex_count(); ++v) {
            CHECK(values.scalar[v] == doctest::Approx(1 / radius).epsilon(0.01));
            CHECK((values.vector[v] - values.scalar[v] * view.normals[v]).norm() < 1e-12);
        }
    }
}

TEST_CASE("a plane has no curvature, a pit has a negative one") {
    auto mesh = dsc::sdk::square(4, 1.0);
    const std::size_t middle = 2 * 5 + 2;
    CHECK(evaluate(dsc::sdk::view_of(mesh)).scalar[middle] == doctest::Approx(0.0));
    mesh.points[middle].z() = -0.2;
    CHECK(evaluate(dsc::sdk::view_of(mesh)).scalar[middle] < -0.1);
}

TEST_CASE("no circle counts as smaller than the smallest") {
    auto mesh = dsc::sdk::square(4, 1.0);
    const std::size_t middle = 2 * 5 + 2;
    mesh.points[middle].z() = 0.5;
    const auto view = dsc::sdk::view_of(mesh);
    CHECK(evaluate(view, 0.1).scalar[middle] > evaluate(view, 3.0).scalar[middle]);
    CHECK(evaluate(view, 3.0).scalar[middle] == doctest::Approx(1 / (3.0 * view.mean_edge)));
}
