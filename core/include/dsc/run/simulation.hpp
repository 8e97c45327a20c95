#pragma once
// Executes the schedule of an experiment: strategies decide, the kernel executes, figures are
// reported.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/hooks/context.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/figures.hpp>
#include <dsc/run/metrics.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::run {

/// The strategies of an experiment, created and guarded by the catalogue.
struct Strategies {
    std::unique_ptr<hooks::InitialMesh> initial_mesh;
    std::unique_ptr<hooks::VelocityField> velocity;
    std::unique_ptr<hooks::Improvement> improvement;
    std::vector<std::unique_ptr<hooks::RefinementPolicy>> refinements;  ///< one per item of the
                                                                        ///< schedule, null for none
    std::vector<std::unique_ptr<hooks::Observer>> observers;
};

/// Creates the strategies and checks that they fit together: a refinement that samples the velocity
/// needs one that can be sampled (ConfigError "config.no_sampling"). Throws as Catalogue::create.
/// [setup]
Strategies make_strategies(const Experiment& experiment, const plugin::Catalogue& catalogue);

/// The inputs of a run besides the experiment.
struct SimulationOptions {
    Workers* workers = nullptr;  ///< null: one thread
    /// Checked between steps, and passed to the strategies whose answers can be discarded: initial
    /// mesh, velocity and refinement. If one of them is told to stop, its answers are discarded:
    /// the run ends as it was before the step, or before the pass of the refinement. An initial
    /// mesh is then a CancelledError.
    const CancelToken* cancel = nullptr;
    std::function<void(const StepMetrics&, std::uint64_t planned)> on_step;  ///< also for row 0
    std::function<void(const kernel::Event&)> on_event;
    std::function<void(const ClassFigures&)> on_repairs;  ///< after the step's events, once per
                                                          ///< class that made requests
    /// Called after row 0 and every step, with the current state; references are valid during the
    /// call.
    std::function<void(const hooks::StepContext&, const mesh::Complex&)> on_state;
    /// Called if a strategy fails: with the complex, which is still valid, and the number of
    /// complete steps. The error is rethrown afterwards.
    std::function<void(const mesh::TetMesh&, std::uint64_t steps)> on_strategy_failure;
    /// Called before the schedule with a function that reports the present state as a strategy's
    /// failure does, and afterwards with an empty one. While a strategy is called, any thread may
    /// call that function, for the case that the strategy never returns.
    std::function<void(std::function<void()> rescue)> on_rescue;
    /// Called every `checkpoint_every` steps and when the run is stopped: with the state of the run
    /// and the number of complete steps. A later simulate() of the same experiment with this state
    /// as `resume` gives the same result.
    std::function<void(std::string state, std::uint64_t steps)> on_checkpoint;
    std::uint64_t checkpoint_every = 0;  ///< in steps; 0: only when the run is stopped
    std::string_view resume;  ///< a state from on_checkpoint; empty: start at the beginning
};

/// The end of a run, in normalised units.
struct SimulationResult {
    mesh::TetMesh mesh;
    surface::TriangleMesh surface;  ///< label interface of `mesh`
    hooks::Attributes attributes;   ///< published by strategies, per point of `mesh`; NaN off the
                                    ///< interface
    RunTotals totals;
    StepMetrics last;
};

/// Number of steps in the schedule.
std::uint64_t planned_steps(const Experiment& experiment);

/// Runs the schedule. `cloud` may be null. A series of steps ends early if it converged or stalled;
/// then the schedule continues with the next item. Converged: the largest speed stayed below
/// stop.speed (in current mean edges per step) for stop.patience steps, or the series has `until:
/// finished` and the velocity has finished. Stalled: less than 1 % of the wanted motion was made in
/// five steps in a row. The status is that of the last series. The result depends on neither the
/// workers nor the callbacks. Throws GeometryError (mesh, cloud outside the box), StrategyError.
/// [setup]
SimulationResult simulate(const Experiment& experiment, Strategies& strategies,
                          const cloud::TargetCloud* cloud, const SimulationOptions& options);

}  // namespace dsc::run
