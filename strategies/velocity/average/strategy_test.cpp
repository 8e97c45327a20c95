// Tests of the velocity on surfaces with known values; the plugin is loaded as in a run.
#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>
#include <dsc/surface/measure.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

std::vector<Vec3> displacements(const dsc::surface::SurfaceView& view, double part,
                                unsigned threads = 1, std::size_t block = 64) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto field = host.create<dsc::hooks::VelocityField>(
        {"average", ConfigNode::map({{"part", part}})}, "velocity");
    return dsc::sdk::displacements(*field, dsc::sdk::step_context(view), threads, block);
}

}  // namespace

TEST_CASE("the corner of an octahedron moves to the middle of its four neighbours") {
    dsc::surface::TriangleMesh mesh;
    mesh.points = {Vec3(1, 0, 0),  Vec3(0, 2, 0),  Vec3(-3, 0, 0),
                   Vec3(0, -4, 0), Vec3(0, 0, 10), Vec3(0, 0, -1)};
    for (std::uint32_t i = 0; i < 4; ++i) {
        mesh.faces.push_back({i, (i + 1) % 4, 4});
        mesh.faces.push_back({(i + 1) % 4, i, 5});
    }
    const auto view = dsc::sdk::view_of(mesh);
    CHECK((displacements(view, 1.0)[4] - (Vec3(-0.5, -0.5, 0) - Vec3(0, 0, 10))).norm() < 1e-14);
    CHECK((displacements(view, 0.3)[4] - 0.3 * Vec3(-0.5, -0.5, -10)).norm() < 1e-14);
}

TEST_CASE("a spike becomes smaller, a plane stays") {
    auto mesh = dsc::sdk::square(8, 1.0);
    const std::size_t middle = 4 * 9 + 4;
    auto out = displacements(dsc::sdk::view_of(mesh), 0.5);
    for (std::size_t j = 1; j < 8; ++j) {
        for (std::size_t i = 1; i < 8; ++i) CHECK(out[j * 9 + i].norm() < 1e-15);
    }
    mesh.points[middle].z() = 0.4;
    out = displacements(dsc::sdk::view_of(mesh), 0.5);
    CHECK((out[middle] - Vec3(0, 0, -0.2)).norm() < 1e-15);
}

TEST_CASE("a sphere shrinks and stays round") {
    auto mesh = dsc::sdk::icosphere(3, 1.0);
    const double start = dsc::surface::volume(mesh);
    for (int step = 0; step < 10; ++step) {
        const auto out = displacements(dsc::sdk::view_of(mesh), 0.5);
        for (std::size_t i = 0; i < out.size(); ++i) mesh.points[i] += out[i];
    }
    CHECK(dsc::surface::volume(mesh) < start);
    double least = 10;
    double most = 0;
    for (const Vec3& p : mesh.points) {
        least = std::min(least, p.norm());
        most = std::max(most, p.norm());
    }
    CHECK(most < 1.0);
    CHECK(least > 0.98 * most);
}

TEST_CASE("vertices that cannot move stay, and blocks and threads make no difference") {
    auto view = dsc::sdk::view_of(dsc::sdk::icosphere(3, 1.0));
    view.movable[7] = 0;
    const auto out = displacements(view, 0.5);
    CHECK(out[7] == Vec3::Zero());
    CHECK(out == displacements(view, 0.5, 3, 17));
}
