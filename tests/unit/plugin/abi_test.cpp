// What crosses the plugins' door by its memory layout: a change of it needs another DSC_ABI_MAJOR,
// and this test notices.
#include <string>

#include <doctest/doctest.h>

#include <dsc/plugin/catalogue.hpp>
#include <dsc/plugin/entry.hpp>

namespace {

using namespace dsc;

#define DSC_SIZE(type) (std::string(#type " ") + std::to_string(sizeof(type)) + "\n")

std::string layout() {
    return DSC_SIZE(plugin::PluginEntry) + DSC_SIZE(plugin::StrategyRecord) +
           DSC_SIZE(plugin::Setup) + DSC_SIZE(config::Field) + DSC_SIZE(config::Schema) +
           DSC_SIZE(config::ConfigNode) + DSC_SIZE(hooks::StepContext) +
           DSC_SIZE(hooks::RefinementContext) + DSC_SIZE(hooks::RefinementRequests) +
           DSC_SIZE(hooks::InitialMeshContext) + DSC_SIZE(hooks::StepFigures) +
           DSC_SIZE(surface::SurfaceView) + DSC_SIZE(surface::TriangleMesh) +
           DSC_SIZE(cloud::TargetCloud) + DSC_SIZE(cloud::Cloud) + DSC_SIZE(cloud::FilterReport) +
           DSC_SIZE(hooks::FilterContext) + DSC_SIZE(mesh::TetMesh) + DSC_SIZE(mesh::Complex) +
           DSC_SIZE(repair::RepairRound) + DSC_SIZE(repair::Request) +
           DSC_SIZE(repair::TopologyCandidate) + DSC_SIZE(repair::TopologyLimits) +
           DSC_SIZE(RandomStream) + DSC_SIZE(Workers) + DSC_SIZE(CancelToken) +
           DSC_SIZE(hooks::Attribute) + DSC_SIZE(hooks::CollapseRequest) +
           DSC_SIZE(hooks::FlipRequest) + DSC_SIZE(hooks::MoveRequest) +
           DSC_SIZE(repair::CreaseRule) + DSC_SIZE(surface::FacePoint) +
           DSC_SIZE(surface::ViewEdge);
}

}  // namespace

// Not noticed: members that change places, and virtual functions; these are for the one who changes
// them.
TEST_CASE("the layout of what crosses the door is that of its ABI number") {
    const std::string recorded = "plugin::PluginEntry 824\n"
                                 "plugin::StrategyRecord 128\n"
                                 "plugin::Setup 48\n"
                                 "config::Field 344\n"
                                 "config::Schema 72\n"
                                 "config::ConfigNode 16\n"
                                 "hooks::StepContext 320\n"
                                 "hooks::RefinementContext 24\n"
                                 "hooks::RefinementRequests 224\n"
                                 "hooks::InitialMeshContext 48\n"
                                 "hooks::StepFigures 40\n"
                                 "surface::SurfaceView 368\n"
                                 "surface::TriangleMesh 72\n"
                                 "cloud::TargetCloud 224\n"
                                 "cloud::Cloud 264\n"
                                 "cloud::FilterReport 120\n"
                                 "hooks::FilterContext 32\n"
                                 "mesh::TetMesh 72\n"
                                 "mesh::Complex 640\n"
                                 "repair::RepairRound 112\n"
                                 "repair::Request 44\n"
                                 "repair::TopologyCandidate 48\n"
                                 "repair::TopologyLimits 24\n"
                                 "RandomStream 44\n"
                                 "Workers 8\n"
                                 "CancelToken 32\n"
                                 "hooks::Attribute 56\n"
                                 "hooks::CollapseRequest 32\n"
                                 "hooks::FlipRequest 16\n"
                                 "hooks::MoveRequest 32\n"
                                 "repair::CreaseRule 16\n"
                                 "surface::FacePoint 40\n"
                                 "surface::ViewEdge 20\n";
    INFO("give DSC_ABI_MAJOR in dsc/plugin/fingerprint.hpp another number, say so in CHANGELOG.md, "
         "and record the new layout here");
    CHECK(DSC_ABI_MAJOR == 8);
    CHECK(layout() == recorded);
}
