// Tests of the curvature on surfaces with known values; the plugin is loaded as in a run.
#include <cmath>

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

Values evaluate(const dsc::surface::SurfaceView& view, const char* area) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto estimator = host.create<dsc::hooks::CurvatureEstimator>(
        {"implicit_fairing", ConfigNode::map({{"area", area}})}, "velocity.curvature");
    estimator->prepare({.surface = view, .box = {}, .to_normalised = {}});
    Values values{std::vector<double>(view.vertex_count()), std::vector<Vec3>(view.vertex_count())};
    estimator->evaluate({0, view.vertex_count()}, values.scalar, values.vector);
    return values;
}

dsc::surface::TriangleMesh turned_inside_out(dsc::surface::TriangleMesh mesh) {
    for (auto& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

}  // namespace

TEST_CASE("on a sphere the mean curvature is 1/r at every resolution") {
    for (const double radius : {0.5, 1.0, 3.0}) {
        for (const unsigned level : {1U, 2U, 3U, 4U}) {
            const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(level, radius));
            const Values values = evaluate(view, "mixed");
            const double tolerance = level <= 2 ? 0.03 : 0.01;
            for (std::size_t i = 0; i < values.scalar.size(); ++i) {
                CHECK(values.scalar[i] == doctest::Approx(1 / radius).epsilon(tolerance));
                CHECK((values.vector[i] - values.scalar[i] * view.positions[i] / radius).norm() <
                      tolerance / radius);
            }
        }
    }
}

TEST_CASE("over the whole ring it is a third of that") {
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(4, 1.0));
    double sum = 0;
    const Values values = evaluate(view, "ring");
    for (const double k : values.scalar) {
        CHECK(k == doctest::Approx(1.0 / 3).epsilon(0.12));
        sum += k;
    }
    CHECK(sum / static_cast<double>(values.scalar.size()) ==
          doctest::Approx(1.0 / 3).epsilon(0.01));
}

TEST_CASE("inside out the sign changes, the vector does not") {
    const auto ball = dsc::sdk::icosphere(3, 1.0);
    const Values outside = evaluate(dsc::sdk::view_of(ball), "mixed");
    const Values inside = evaluate(dsc::sdk::view_of(turned_inside_out(ball)), "mixed");
    for (std::size_t i = 0; i < ball.points.size(); ++i) {
        CHECK(inside.scalar[i] == doctest::Approx(-outside.scalar[i]).epsilon(1e-9));
        CHECK((inside.vector[i] - outside.vector[i]).norm() < 1e-9);
    }
}

TEST_CASE("a plane has none, however its vertices lie in it") {
    const auto uneven = dsc::sdk::moved(dsc::sdk::square(8, 1.0), [](const Vec3& p) {
        return Vec3(p.x() + 0.05 * std::sin(9 * p.x() + 4 * p.y()),
                    p.y() + 0.05 * std::cos(7 * p.y() - p.x()), 0.0);
    });
    const Values values = evaluate(dsc::sdk::view_of(uneven), "mixed");
    for (std::size_t j = 1; j < 8; ++j) {
        for (std::size_t i = 1; i < 8; ++i) CHECK(std::abs(values.scalar[j * 9 + i]) < 1e-10);
    }
}

TEST_CASE("a cylinder has half of 1/r") {
    const unsigned n = 96;
    const double radius = 0.5;
    dsc::surface::TriangleMesh tube;
    for (unsigned k = 0; k < 8; ++k) {
        for (unsigned i = 0; i < n; ++i) {
            const double angle = 2 * 3.14159265358979 * i / n;
            tube.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.04 * k);
        }
    }
    for (unsigned k = 0; k + 1 < 8; ++k) {
        for (unsigned i = 0; i < n; ++i) {
            const unsigned a = k * n + i;
            const unsigned b = k * n + (i + 1) % n;
            tube.faces.push_back({a, b, b + n});
            tube.faces.push_back({a, b + n, a + n});
        }
    }
    const Values values = evaluate(dsc::sdk::view_of(tube), "mixed");
    for (unsigned i = 0; i < n; ++i)
        CHECK(values.scalar[4 * n + i] == doctest::Approx(0.5 / radius).epsilon(0.01));
}

TEST_CASE("degenerate faces give finite values") {
    dsc::surface::TriangleMesh fan;
    fan.points = {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 1e-14, 0), Vec3(1, 1, 1)};
    fan.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
    for (const char* area : {"mixed", "ring"}) {
        const Values values = evaluate(dsc::sdk::view_of(fan), area);
        for (const double k : values.scalar) CHECK(std::isfinite(k));
    }
}
