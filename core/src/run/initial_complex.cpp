// Builds and adopts the initial mesh.
#include "initial_complex.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/run/mesh_files.hpp>

namespace dsc::run {
namespace {

void require_inside(const cloud::TargetCloud& cloud, const Box3& box) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (box.contains(cloud[i])) continue;
        throw GeometryError("cloud.outside_box", "cloud",
                            fmt::format("point {} lies outside the box of the initial mesh", i + 1),
                            "lower input.normalize.scale or make the initial mesh larger");
    }
}

}  // namespace

mesh::Complex initial_complex(const Experiment& experiment, Strategies& strategies,
                              const cloud::TargetCloud* cloud, const CancelToken* cancel,
                              Workers& workers, RunTotals& totals) {
    hooks::InitialMeshContext context;
    context.cloud = cloud;
    context.seed = experiment.seed;
    const CancelToken told(cancel);
    context.cancel = &told;
    const MeshFiles files;
    context.files = &files;
    context.workers = &workers;
    mesh::TetMesh mesh = [&] {
        const Timed timed(totals.seconds.initial_mesh);
        return strategies.initial_mesh->build(context);
    }();
    if (told.told()) throw CancelledError("the run was stopped while it made its initial mesh");
    totals.initial_mesh = strategies.initial_mesh->figures();
    totals.initial_mesh_seconds = strategies.initial_mesh->seconds();
    totals.warnings = strategies.initial_mesh->warnings();
    const Timed timed(totals.seconds.adopt);
    mesh::Complex complex = mesh::adopt(
        std::move(mesh), fmt::format("initial mesh '{}'", experiment.initial_mesh.type),
        &totals.adopted, strategies.improvement->topology_limits().min_component, &workers);
    if (cloud != nullptr) require_inside(*cloud, complex.box());
    return complex;
}

}  // namespace dsc::run
