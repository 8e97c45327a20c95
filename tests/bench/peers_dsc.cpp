// The part of dsc in the comparison with other programs.
#include <memory>
#include <string>
#include <utility>

#include <dsc/mesh/adopt.hpp>
#include <dsc/run/input.hpp>
#include <dsc/run/input_files.hpp>
#include <dsc/run/reconstruct.hpp>
#include <dsc/run/simulation.hpp>

#include "peers.hpp"

namespace dsc::bench {

Remeshed repair_with_dsc(const Plugins& plugins, const mesh::TetMesh& mesh,
                         std::span<const std::string> parameters, unsigned steps) {
    const config::StrategyConfig improvement = strategy("dsc", parameters);
    Body body(mesh::adopt(mesh, "the mesh of the comparison"),
              plugins.host().create<hooks::Improvement>(improvement, "improvement"));
    Remeshed result;
    result.cost = cost_of([&] {
        for (unsigned step = 0; step < steps; ++step) body.idle();
    });
    result.mesh = body.deformer().complex().to_mesh();
    return result;
}

Reconstructed reconstruct_with_dsc(const Plugins& plugins, std::span<const Vec3> points) {
    const auto files = std::make_shared<run::InputFiles>();
    cloud::Cloud cloud;
    cloud.points.assign(points.begin(), points.end());
    const std::string file = files->add_cloud("cloud", std::move(cloud)).string();
    const run::LoadedExperiment loaded = run::resolve_experiment(
        run::reconstruction_of(file),
        [&](const auto&) -> const config::StrategyLookup& { return plugins.host(); });
    const run::Experiment& experiment = loaded.experiment;
    Reconstructed result;
    cloud::Transform to_normalised;
    result.cost = cost_of([&] {
        const run::LoadedInput input =
            run::load_input(experiment.input.value(), experiment.seed, plugins.host(), *files);
        run::Strategies strategies = run::make_strategies(experiment, plugins.host());
        result.surface = run::simulate(experiment, strategies, &input.target, {}).surface;
        to_normalised = input.target.transform();
    });
    for (Vec3& p : result.surface.points) p = to_normalised.inverse(p);
    return result;
}

}  // namespace dsc::bench
