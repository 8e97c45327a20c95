#pragma once
// Carries out the schedule of an experiment: strategies say what, the kernel does how, figures are reported.

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/hooks/context.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/figures.hpp>
#include <dsc/surface/triangle_mesh.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::run {

/// The strategies of an experiment, made and guarded by the catalogue.
struct Strategies {
    std::unique_ptr<hooks::InitialMesh> initial_mesh;
    std::unique_ptr<hooks::VelocityField> velocity;
    std::unique_ptr<hooks::Improvement> improvement;
    std::vector<std::unique_ptr<hooks::RefinementPolicy>>
        refinements;  ///< one an item of the schedule, null for none
    std::vector<std::unique_ptr<hooks::Observer>> observers;
};

/// Makes them and checks that they fit together: a refinement that samples the velocity needs one that can be sampled
/// (ConfigError "config.no_sampling"). Throws as Catalogue::create. [setup]
Strategies make_strategies(const Experiment& experiment, const plugin::Catalogue& catalogue);

/// What a run is given besides the experiment.
struct DriveOptions {
    Workers* workers = nullptr;           ///< null: one thread
    const CancelToken* cancel = nullptr;  ///< checked between steps
    std::function<bool()> out_of_time;    ///< checked between steps; true ends the run like a cancellation
    std::function<void(const StepMetrics&, std::uint64_t planned)> on_step;  ///< also for row 0
    std::function<void(const kernel::Event&)> on_event;
    std::function<void(const ClassFigures&)> on_repairs;  ///< after the step's events, each class asked for
    /// After row 0 and every step: the state as it stands, good for the length of the call.
    std::function<void(const hooks::StepContext&, const mesh::Complex&)> on_state;
    /// A strategy failed: the complex as it stands, which is valid, and the number of whole steps behind it. The error goes
    /// on afterwards.
    std::function<void(const mesh::TetMesh&, std::uint64_t steps)> on_strategy_failure;
    /// Every so many steps, and where the run is stopped: the state of the run and the number of steps behind it. A later
    /// drive() of the same experiment with this state as `resume` goes on to the same result.
    std::function<void(std::string state, std::uint64_t steps)> on_checkpoint;
    std::uint64_t checkpoint_every = 0;  ///< steps; 0: only where the run is stopped
    std::string_view resume;             ///< a state that on_checkpoint was given; empty: from the start
};

/// Where a run ended, normalised units.
struct DriveResult {
    mesh::TetMesh mesh;
    surface::TriangleMesh surface;  ///< label interface of `mesh`
    hooks::Attributes attributes;   ///< published by strategies, per point of `mesh`; NaN off the interface
    RunTotals totals;
    StepMetrics last;
};

/// Number of steps that the schedule asks for.
std::uint64_t planned_steps(const Experiment& experiment);

/// Runs the schedule. `cloud` may be null. A series of steps ends early when it converged (the largest speed stayed
/// below stop.speed mean edges for stop.patience steps, or it has `until: finished` and the velocity says so) or stalled (in five steps in a row less than 1 % of the asked
/// motion came about); the schedule goes on behind it, the status is that of the last series. The result depends on
/// neither the workers nor the callbacks. Throws GeometryError (mesh, cloud outside the box), StrategyError. [setup]
DriveResult drive(const Experiment& experiment, Strategies& strategies, const cloud::TargetCloud* cloud,
                  const DriveOptions& options);

}  // namespace dsc::run
