// Creates the strategies of an experiment and checks that they fit together.
#include <fmt/format.h>

#include <dsc/config/diagnostics.hpp>
#include <dsc/run/simulation.hpp>

namespace dsc::run {

Strategies make_strategies(const Experiment& experiment, const plugin::Catalogue& catalogue) {
    Strategies all;
    all.initial_mesh =
        catalogue.create<hooks::InitialMesh>(experiment.initial_mesh, "initial_mesh");
    all.velocity = catalogue.create<hooks::VelocityField>(experiment.velocity, "velocity");
    all.improvement = catalogue.create<hooks::Improvement>(experiment.improvement, "improvement");
    for (std::size_t i = 0; i < experiment.schedule.size(); ++i) {
        const config::StrategyConfig& refine = experiment.schedule[i].refine;
        const std::string path = fmt::format("schedule.{}.refine", i);
        all.refinements.push_back(
            refine.empty() ? nullptr : catalogue.create<hooks::RefinementPolicy>(refine, path));
        if (all.refinements.back() && all.refinements.back()->needs_sampling() &&
            !all.velocity->can_sample()) {
            config::fail("config.no_sampling", refine.params.position(),
                         fmt::format("{}: refinement '{}' reads the velocity between the vertices, "
                                     "but velocity '{}' has no value there",
                                     path, refine.type, experiment.velocity.type),
                         "choose another refinement or a velocity that can be sampled");
        }
    }
    for (std::size_t i = 0; i < experiment.observers.size(); ++i) {
        all.observers.push_back(catalogue.create<hooks::Observer>(experiment.observers[i],
                                                                  fmt::format("observers.{}", i)));
    }
    return all;
}

}  // namespace dsc::run
