#pragma once
// Makes the complex with which a run starts.

#include <dsc/run/simulation.hpp>

namespace dsc::run {

/// Builds the mesh with the experiment's generator and adopts it. `totals` receives the generator's
/// figures, warnings and seconds. `cloud` and `cancel` may be null. Throws StrategyError,
/// GeometryError (the mesh, a cloud outside its box). [setup]
mesh::Complex initial_complex(const Experiment& experiment, Strategies& strategies,
                              const cloud::TargetCloud* cloud, const CancelToken* cancel,
                              Workers& workers, RunTotals& totals);

}  // namespace dsc::run
