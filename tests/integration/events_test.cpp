// The demos that change the topology, step by step: the interface is a 2-manifold after every step,
// and the events of the step account for every change of shells and genus in a recount of the whole
// mesh.
#include <doctest/doctest.h>

#include <dsc/host/host.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/adopt.hpp>
#include <dsc/mesh/validate.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/simulation.hpp>
#include <dsc/surface/analysis.hpp>
#include <dsc/surface/surface_view.hpp>

#include "results.hpp"

namespace {

using namespace dsc;

struct Outcome {
    mesh::InterfaceCounts counts;
    kernel::EventCounts events;
    std::uint64_t steps = 0;
};

/// Recounts after every step.
Outcome run_counting(const std::string& name) {
    host::Host host;
    test::load_strategies(host);
    const run::LoadedExperiment loaded = run::load_experiment(
        test::config(name), {},
        [&](const std::vector<std::string>&) -> const config::StrategyLookup& { return host; });
    run::Strategies strategies = run::make_strategies(loaded.experiment, host);
    kernel::Deformer deformer(mesh::adopt(strategies.initial_mesh->build({}), name));
    Outcome outcome;
    outcome.counts = mesh::count_interface(deformer.complex());
    surface::SurfaceView view;
    std::vector<Vec3> displacements;
    for (std::uint64_t step = 1; step <= run::planned_steps(loaded.experiment); ++step) {
        surface::build_view(deformer.complex(), view);
        const hooks::StepContext context{.step = step,
                                         .surface = view,
                                         .target_length = deformer.target_length(),
                                         .box = deformer.complex().box(),
                                         .to_normalised = {}};
        displacements.assign(view.vertex_count(), Vec3::Zero());
        strategies.velocity->prepare(context);
        strategies.velocity->evaluate({0, view.vertex_count()}, displacements);
        hooks::Improvement& improvement = *strategies.improvement;
        kernel::RepairPolicy policy;
        policy.propose = [&](const repair::RepairRound& round, std::vector<repair::Request>& out) {
            improvement.propose(context, round, out);
        };
        policy.select = [&](auto candidates, auto accept) {
            improvement.select(context, candidates, accept);
        };
        policy.topology = improvement.topology_limits();
        policy.flatness = improvement.flatness();
        const kernel::EventCounts e =
            deformer.step(view.vertex_ids, displacements, policy).event_counts;

        CAPTURE(step);
        const mesh::InterfaceCounts now = mesh::count_interface(deformer.complex());
        CHECK(static_cast<long>(now.shells) - static_cast<long>(outcome.counts.shells) ==
              static_cast<long>(e.split + e.born) - static_cast<long>(e.merge + e.vanished));
        CHECK(now.genus() - outcome.counts.genus() ==
              static_cast<long>(e.handle_opened) - static_cast<long>(e.handle_closed));
        const surface::SurfaceReport report =
            surface::analyse(surface::extract_interface(deformer.complex().to_mesh()));
        CHECK(report.closed_manifold());
        CHECK(report.shells == now.shells);
        CHECK(report.genus == now.genus());
        outcome.counts = now;
        outcome.events.merge += e.merge;
        outcome.events.split += e.split;
        ++outcome.steps;
    }
    CHECK(mesh::validate(deformer.complex()).faults == std::vector<std::string>{});
    return outcome;
}

}  // namespace

TEST_CASE(
    "two spheres that meet: the books balance and the interface is a manifold at every step") {
    const Outcome outcome = run_counting("demos/merge_spheres.yaml");
    CHECK(outcome.steps == 32);
    CHECK(outcome.events.merge == 1);
    CHECK(outcome.counts.shells == 1);
    CHECK(outcome.counts.genus() == 0);
}

TEST_CASE("a dumbbell that is drawn apart: the books balance and the interface is a manifold at "
          "every step") {
    const Outcome outcome = run_counting("demos/split_dumbbell.yaml");
    CHECK(outcome.steps == 43);
    CHECK(outcome.events.split == 1);
    CHECK(outcome.counts.shells == 2);
    CHECK(outcome.counts.genus() == 0);
}
