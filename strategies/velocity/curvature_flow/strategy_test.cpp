// Tests of the velocity on surfaces with known values; the plugin is loaded as in a run.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

struct Bench {
    Bench() {
        host.load(DSC_TEST_PLUGIN);
        host.load(std::filesystem::path(DSC_TEST_PLUGIN).parent_path() /
                  "libdsc_implicit_fairing.so");
    }
    std::unique_ptr<dsc::hooks::VelocityField> make(const ConfigNode& params) const {
        return host.create<dsc::hooks::VelocityField>({"curvature_flow", params}, "velocity");
    }
    dsc::host::Host host;
};

/// Mean radius after this number of steps, down to half the initial radius of 1, without a kernel.
double radius_error(const Bench& bench, unsigned level, double time_step) {
    const auto field = bench.make(ConfigNode::map({{"time_step", time_step}}));
    auto mesh = dsc::sdk::icosphere(level, 1.0);
    const int steps = static_cast<int>(0.1875 / time_step + 0.5);
    for (int step = 0; step < steps; ++step) {
        const auto view = dsc::sdk::view_of(mesh);
        const auto out = dsc::sdk::displacements(*field, dsc::sdk::step_context(view));
        for (std::size_t i = 0; i < out.size(); ++i) mesh.points[i] += out[i];
    }
    double sum = 0;
    for (const Vec3& p : mesh.points) sum += p.norm();
    return std::abs(sum / static_cast<double>(mesh.points.size()) - 0.5) / 0.5;
}

}  // namespace

TEST_CASE("the vertices of a sphere move inwards by 2 dt / r") {
    const Bench bench;
    const auto field = bench.make(ConfigNode::map({{"time_step", 0.002}}));
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(4, 0.8));
    const auto out = dsc::sdk::displacements(*field, dsc::sdk::step_context(view));
    for (std::size_t i = 0; i < out.size(); ++i)
        CHECK((out[i] + 2 * 0.002 / 0.8 * view.positions[i] / 0.8).norm() < 2e-4 * 0.8);
}

TEST_CASE("down to half the radius a sphere follows sqrt(r^2 - 4 t), the better the finer") {
    const Bench bench;
    const double coarse = radius_error(bench, 2, 0.0025);
    const double fine = radius_error(bench, 3, 0.000625);
    CHECK(coarse < 0.02);
    CHECK(fine < 0.4 * coarse);
}

TEST_CASE("vertices that cannot move stay, and blocks and threads make no difference") {
    const Bench bench;
    const auto field = bench.make(ConfigNode::map({}));
    auto view = dsc::sdk::view_of(dsc::sdk::icosphere(3, 1.0));
    view.movable[7] = 0;
    const auto out = dsc::sdk::displacements(*field, dsc::sdk::step_context(view), 1, 1000);
    CHECK(out[7] == Vec3::Zero());
    CHECK(out == dsc::sdk::displacements(*field, dsc::sdk::step_context(view), 3, 17));
}
