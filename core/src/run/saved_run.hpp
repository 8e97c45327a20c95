#pragma once
// The part of a checkpoint besides the complex: the place in the schedule, the sums, the states of
// the strategies.

#include <dsc/base/state.hpp>
#include <dsc/run/simulation.hpp>

namespace dsc::run {

/// The place at which a run continues.
struct SchedulePlace {
    std::uint32_t item = 0;   ///< index in the schedule
    std::uint32_t steps = 0;  ///< completed steps of this item
    std::uint32_t quiet = 0;  ///< number of last steps below the stop criterion
    std::uint32_t stuck = 0;  ///< number of last steps in which almost nothing moved
};

void save(StateWriter& out, const RunTotals& totals);
/// Names of repair classes are not loaded, because the strategies provide them.
void load(StateReader& in, RunTotals& totals);

void save(StateWriter& out, const Strategies& strategies);
void load(StateReader& in, Strategies& strategies);

}  // namespace dsc::run
