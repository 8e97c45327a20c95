// Tests of the curvature on surfaces with known values; the plugin is loaded as in a run.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

struct Values {
    std::vector<double> scalar;
    std::vector<Vec3> vector;
};

Values evaluate(const dsc::surface::SurfaceView& view, bool per_area) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto estimator = host.create<dsc::hooks::CurvatureEstimator>(
        {"angular_defect", ConfigNode::map({{"per_area", per_area}})}, "velocity.curvature");
    estimator->prepare({.surface = view, .box = {}, .to_normalised = {}});
    Values values{std::vector<double>(view.vertex_count()), std::vector<Vec3>(view.vertex_count())};
    estimator->evaluate({0, view.vertex_count()}, values.scalar, values.vector);
    return values;
}

}  // namespace

TEST_CASE("the defects of a closed surface add up to 4 pi") {
    for (const unsigned level : {0U, 1U, 3U}) {
        const auto view =
            dsc::sdk::view_of(dsc::sdk::moved(dsc::sdk::icosphere(level, 1.0), [](const Vec3& p) {
                return Vec3(2 * p.x(), p.y() + 0.3 * p.x() * p.x(), p.z());
            }));
        double sum = 0;
        for (const double d : evaluate(view, false).scalar) sum += d;
        CHECK(sum == doctest::Approx(4 * std::numbers::pi).epsilon(1e-10));
    }
}

TEST_CASE("per area the defect of a sphere converges to 1/r^2") {
    const double radius = 0.7;
    double last = 1;
    for (const unsigned level : {2U, 3U, 4U}) {
        const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(level, radius));
        double worst = 0;
        for (const double k : evaluate(view, true).scalar)
            worst = std::max(worst, std::abs(k * radius * radius - 1));
        CHECK(worst < 0.4 * last);
        last = worst;
    }
    CHECK(last < 0.02);
}

TEST_CASE("signs: corner of a cube, plane, saddle") {
    dsc::surface::TriangleMesh corner;
    corner.points = {Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)};
    corner.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    const auto at_corner = evaluate(dsc::sdk::view_of(corner), false);
    CHECK(at_corner.scalar[0] == doctest::Approx(std::numbers::pi / 2));
    CHECK((at_corner.vector[0] - std::numbers::pi / 2 * Vec3(1, 1, 1).normalized()).norm() < 1e-12);

    const auto flat = dsc::sdk::square(4, 1.0);
    CHECK(std::abs(evaluate(dsc::sdk::view_of(flat), false).scalar[12]) < 1e-12);
    const auto saddle = dsc::sdk::moved(
        flat, [](const Vec3& p) { return Vec3(p.x(), p.y(), p.x() * p.x() - p.y() * p.y()); });
    CHECK(evaluate(dsc::sdk::view_of(saddle), false).scalar[12] < -0.1);
}

TEST_CASE("degenerate faces give finite values") {
    dsc::surface::TriangleMesh fan;
    fan.points = {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
    fan.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
    for (const bool per_area : {false, true}) {
        for (const double k : evaluate(dsc::sdk::view_of(fan), per_area).scalar)
            CHECK(std::isfinite(k));
    }
}
