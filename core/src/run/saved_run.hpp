#pragma once
// The part of a checkpoint besides the complex: the place in the schedule, the sums, the states of
// the strategies.

#include <exception>
#include <span>
#include <string>

#include <dsc/base/state.hpp>
#include <dsc/run/simulation.hpp>

namespace dsc::run {

/// The place at which a run continues.
struct SchedulePlace {
    std::uint32_t item = 0;      ///< index in the schedule
    std::uint32_t steps = 0;     ///< completed steps of this item
    std::uint32_t quiet = 0;     ///< number of last steps below the stop criterion
    std::uint32_t stuck = 0;     ///< number of last steps in which almost nothing moved
    std::uint32_t refining = 0;  ///< 1: within the refinement that comes next
    std::uint32_t pass = 0;      ///< completed passes of that refinement
};

/// What a strategy saved at some time, or why it could not.
struct StrategyState {
    const hooks::Strategy* strategy = nullptr;
    std::string bytes{};
    std::exception_ptr fault{};
};

/// Asks the strategy for its state; a fault is thrown only when the state is saved. [step]
StrategyState state_of(const hooks::Strategy& strategy);

void save(StateWriter& out, const RunTotals& totals);
/// Names of repair classes are not loaded, because the strategies provide them.
void load(StateReader& in, RunTotals& totals);

/// `earlier` contains the states of the strategies that are not saved as they are now. Throws the
/// fault of such a state.
void save(StateWriter& out, const Strategies& strategies,
          std::span<const StrategyState> earlier = {});
void load(StateReader& in, Strategies& strategies);

}  // namespace dsc::run
