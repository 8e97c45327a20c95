// Tests of the mesh; the plugin is loaded as in a run.
#include <numbers>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>

namespace {

using dsc::config::ConfigNode;

dsc::mesh::TetMesh build(const ConfigNode& params) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    return host.create<dsc::hooks::InitialMesh>({"@NAME@", params}, "initial_mesh")->build({});
}

}  // namespace

TEST_CASE("every tet is positive and together they fill the box") {
    const auto mesh = build(ConfigNode::map({{"cells", 6}}));
    CHECK(mesh.tets.size() == 6 * 6 * 6 * 6);
    double volume = 0;
    for (const auto& [a, b, c, d] : mesh.tets) {
        const auto& p = mesh.points;
        const double tet = dsc::geometry::tet_volume(p[a], p[b], p[c], p[d]);
        CHECK(tet > 0);
        volume += tet;
    }
    CHECK(volume == doctest::Approx(27.0));
}

TEST_CASE("the label is a torus: one surface with a hole, of the right volume") {
    const auto complex =
        dsc::mesh::adopt(build(ConfigNode::map({{"ring", 0.8}, {"tube", 0.4}})), "@NAME@");
    CHECK(dsc::mesh::validate(complex).valid());
    const auto counts = dsc::mesh::count_interface(complex);
    CHECK(counts.shells == 1);
    CHECK(counts.genus() == 1);
    const double exact = 2 * std::numbers::pi * std::numbers::pi * 0.8 * 0.4 * 0.4;
    CHECK(dsc::mesh::labelled_volume(complex) == doctest::Approx(exact).epsilon(0.05));
}

TEST_CASE("a tube as thick as the ring, or one that leaves the box, is refused") {
    CHECK_THROWS_AS(build(ConfigNode::map({{"ring", 0.4}, {"tube", 0.4}})), dsc::ConfigError);
    CHECK_THROWS_AS(build(ConfigNode::map({{"ring", 1.2}, {"tube", 0.4}})), dsc::ConfigError);
}
