// Tests of the velocity on surfaces with known values; the plugin is loaded as in a run.
#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

std::vector<Vec3> displacements(const dsc::surface::SurfaceView& view, double inflation,
                                double tension, unsigned threads = 1, std::size_t block = 64) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto params = ConfigNode::map({{"inflation", inflation}, {"tension", tension}});
    const auto field = host.create<dsc::hooks::VelocityField>({"@NAME@", params}, "velocity");
    return dsc::sdk::displacements(*field, dsc::sdk::step_context(view), threads, block);
}

}  // namespace

TEST_CASE("without tension every vertex moves the same distance outwards") {
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(3, 0.8));
    const auto out = displacements(view, 0.2, 0.0);
    for (std::size_t v = 0; v < out.size(); ++v) {
        CHECK((out[v] - 0.2 * view.mean_edge * view.normals[v]).norm() < 1e-14);
        CHECK(out[v].dot(view.positions[v]) > 0);
    }
}

TEST_CASE("without inflation a spike is pulled in and a plane stays") {
    auto mesh = dsc::sdk::square(8, 1.0);
    const std::size_t middle = 4 * 9 + 4;
    CHECK(displacements(dsc::sdk::view_of(mesh), 0.0, 0.5)[middle].norm() < 1e-15);
    mesh.points[middle].z() = 0.4;
    CHECK((displacements(dsc::sdk::view_of(mesh), 0.0, 0.5)[middle] - Vec3(0, 0, -0.2)).norm() <
          1e-15);
}

TEST_CASE("blocks and threads make no difference") {
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(3, 1.0));
    CHECK(displacements(view, 0.1, 0.3) == displacements(view, 0.1, 0.3, 3, 17));
}
