#pragma once
// The complex that a run starts with.

#include <dsc/run/driver.hpp>

namespace dsc::run {

/// What the experiment's strategy for the initial mesh builds, as a complex; `totals` takes what it tells, and its seconds.
/// `cloud` and `cancel` may be null. Throws StrategyError, GeometryError (the mesh, a cloud outside its box). [setup]
mesh::Complex initial_complex(const Experiment& experiment, Strategies& strategies, const cloud::TargetCloud* cloud,
                              const CancelToken* cancel, Workers& workers, RunTotals& totals);

}  // namespace dsc::run
