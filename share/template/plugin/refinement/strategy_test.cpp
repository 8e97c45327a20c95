// Tests of the requests on surfaces with known values; the plugin is loaded as in a run.
#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/steps.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::Vec3;
using dsc::config::ConfigNode;

std::vector<std::array<std::uint32_t, 2>> split_edges(const dsc::surface::SurfaceView& view,
                                                      double bend, double shortest = 0.0) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto params = ConfigNode::map({{"bend", bend}, {"shortest", shortest}});
    const auto policy =
        host.create<dsc::hooks::RefinementPolicy>({"@NAME@", params}, "schedule.1.refine");
    const auto step = dsc::sdk::step_context(view);
    dsc::hooks::RefinementRequests requests;
    policy->refine({step}, requests);
    CHECK(requests.split_faces.empty());
    return requests.split_edges;
}

// A square of 4 x 4 cells, folded along the line x = 0 of its vertices 2, 7, 12, 17 and 22.
dsc::surface::SurfaceView folded() {
    return dsc::sdk::view_of(dsc::sdk::moved(dsc::sdk::square(4, 1.0), [](const Vec3& p) {
        return Vec3(p.x(), p.y(), p.x() > 0 ? 0.5 * p.x() : 0.0);
    }));
}

}  // namespace

TEST_CASE("the edges of a fold are split, those of flat parts are not") {
    const std::vector<std::array<std::uint32_t, 2>> fold = {{2, 7}, {7, 12}, {12, 17}, {17, 22}};
    CHECK(split_edges(folded(), 20.0) == fold);  // the fold's angle is 26.6 degrees
    CHECK(split_edges(folded(), 30.0).empty());
    CHECK(split_edges(dsc::sdk::view_of(dsc::sdk::square(4, 1.0)), 1.0).empty());
}

TEST_CASE("short edges are not split") {
    const auto view = folded();
    // The edges of the fold are 0.5 long.
    CHECK(split_edges(view, 20.0, 0.49 / view.mean_edge).size() == 4);
    CHECK(split_edges(view, 20.0, 0.51 / view.mean_edge).empty());
}

TEST_CASE("a sphere bends everywhere, each edge is requested once") {
    const auto view = dsc::sdk::view_of(dsc::sdk::icosphere(1, 1.0));
    CHECK(split_edges(view, 5.0).size() == 3 * view.face_count() / 2);
}
