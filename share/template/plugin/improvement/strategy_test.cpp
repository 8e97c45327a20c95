// Tests of the requests on a mesh with a known fault; the plugin is loaded as in a run.
#include <cmath>

#include <doctest/doctest.h>

#include <dsc/base/error.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/host/host.hpp>
#include <dsc/mesh/adopt.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

// A ball in a box of 8 x 8 x 8 cells whose plane x = 0 is moved by `shift` cells: near 1 the tets
// to its right are flat.
dsc::mesh::Complex ball(double shift) {
    dsc::generate::LatticeOptions options;
    options.cells = 8;
    const double cell = dsc::generate::finest_cell(options);
    dsc::mesh::TetMesh mesh = dsc::generate::make_lattice(
        options, [](const Vec3&, double) { return false; }, "ball");
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        Vec3 centre = Vec3::Zero();
        for (const std::uint32_t v : mesh.tets[t]) centre += 0.25 * mesh.points[v];
        mesh.labels[t] = centre.norm() < 0.9 ? 1 : 0;
    }
    for (Vec3& p : mesh.points) {
        if (std::abs(p.x()) < 1e-9) p.x() = shift * cell;
    }
    return dsc::mesh::adopt(mesh, "ball", nullptr, 0.0);
}

std::vector<dsc::repair::Request> proposals(const dsc::mesh::Complex& complex, double poor,
                                            double hopeless) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto params = ConfigNode::map({{"poor", poor}, {"hopeless", hopeless}});
    const auto strategy = host.create<dsc::hooks::Improvement>({"@NAME@", params}, "improvement");
    std::vector<dsc::mesh::TetId> dirty;
    for (dsc::mesh::TetId t = 0; t < complex.tet_slots(); ++t) dirty.push_back(t);
    const dsc::surface::SurfaceView view;
    const dsc::hooks::StepContext step{.surface = view, .box = {}, .to_normalised = {}};
    const dsc::repair::RepairRound round{
        complex, dirty, {}, {}, {}, 1.0, strategy->flatness(), 0, true};
    std::vector<dsc::repair::Request> out;
    strategy->propose(step, round, out);
    return out;
}

std::size_t count(const std::vector<dsc::repair::Request>& requests,
                  dsc::repair::Operation operation) {
    std::size_t found = 0;
    for (const auto& request : requests) found += request.operation == operation ? 1 : 0;
    return found;
}

std::size_t tets_below(const dsc::mesh::Complex& complex, double quality) {
    std::size_t found = 0;
    for (dsc::mesh::TetId t = 0; t < complex.tet_slots(); ++t)
        found += static_cast<double>(complex.quality(t)) < quality ? 1 : 0;
    return found;
}

}  // namespace

TEST_CASE("good tets are not changed") { CHECK(proposals(ball(0.0), 0.3, 0.05).empty()); }

TEST_CASE(
    "an edge or a face of each poor tet is to be removed, each hopeless tet is to be collapsed") {
    const auto complex = ball(0.98);
    const auto requests = proposals(complex, 0.3, 0.1);
    CHECK(tets_below(complex, 0.1) > 0);
    CHECK(tets_below(complex, 0.3) >= tets_below(complex, 0.1));
    CHECK(count(requests, dsc::repair::Operation::edge_removal) == tets_below(complex, 0.3));
    CHECK(count(requests, dsc::repair::Operation::face_removal) == tets_below(complex, 0.3));
    CHECK(count(requests, dsc::repair::Operation::edge_collapse) == tets_below(complex, 0.1));
    CHECK(proposals(complex, 0.0, 0.0).empty());
}

TEST_CASE("only free vertices are smoothed") {
    const auto complex = ball(0.98);
    const auto requests = proposals(complex, 0.3, 0.1);
    CHECK(count(requests, dsc::repair::Operation::smooth_optimise) > 0);
    for (const auto& request : requests) {
        if (request.operation != dsc::repair::Operation::smooth_optimise) continue;
        CHECK_FALSE(complex.on_interface(request.vertices[0]));
        CHECK_FALSE(complex.on_box(request.vertices[0]));
    }
}

TEST_CASE("thresholds in the wrong order are refused") {
    CHECK_THROWS_AS(proposals(ball(0.0), 0.1, 0.2), dsc::ConfigError);
}
