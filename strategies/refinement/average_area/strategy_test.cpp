// Tests of the requests on surfaces with known values; the plugin is loaded as in a run.
#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/sdk/surfaces.hpp>

namespace {

using dsc::config::ConfigNode;

std::vector<std::uint32_t> split_faces(const dsc::surface::SurfaceView& view,
                                       const ConfigNode& params) {
    dsc::host::Host host;
    host.load(DSC_TEST_PLUGIN);
    const auto policy =
        host.create<dsc::hooks::RefinementPolicy>({"average_area", params}, "schedule.1.refine");
    CHECK_FALSE(policy->needs_sampling());
    const dsc::hooks::StepContext step{.surface = view, .box = {}, .to_normalised = {}};
    dsc::hooks::RefinementRequests requests;
    policy->refine({step}, requests);
    CHECK(requests.split_edges.empty());
    CHECK(requests.sizing.empty());
    CHECK(requests.relabel.empty());
    return requests.split_faces;
}

// Squares of 2 x 2 cells whose right half is stretched: four small faces and four three times as
// large.
dsc::surface::SurfaceView uneven() {
    return dsc::sdk::view_of(dsc::sdk::moved(dsc::sdk::square(2, 1.0), [](const dsc::Vec3& p) {
        return dsc::Vec3(p.x() > 0 ? 3 * p.x() : p.x(), p.y(), 0.0);
    }));
}

}  // namespace

TEST_CASE("faces of at least the average area are split, no others") {
    // Cells in the order of x: faces 0, 1 small, 2, 3 large, 4, 5 small, 6, 7 large.
    CHECK(split_faces(uneven(), ConfigNode::map()) == std::vector<std::uint32_t>{2, 3, 6, 7});
}

TEST_CASE("faces of equal area are all split") {
    for (const unsigned n : {1U, 3U, 7U}) {
        const auto view = dsc::sdk::view_of(dsc::sdk::square(n, 0.37));
        CHECK(split_faces(view, ConfigNode::map()).size() == view.face_count());
    }
}

TEST_CASE("the factor moves the bound") {
    CHECK(split_faces(uneven(), ConfigNode::map({{"factor", 1.6}})).empty());
    CHECK(split_faces(uneven(), ConfigNode::map({{"factor", 0.4}})).size() == 8);
}

TEST_CASE("without faces nothing is requested") {
    CHECK(split_faces(dsc::sdk::view_of({}), ConfigNode::map()).empty());
}
