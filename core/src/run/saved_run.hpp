#pragma once
// What a checkpoint holds of a run besides the complex: its place in the schedule, its sums, its strategies' state.

#include <dsc/base/state.hpp>
#include <dsc/run/driver.hpp>

namespace dsc::run {

/// Where a run goes on.
struct SchedulePlace {
    std::uint32_t item = 0;   ///< of the schedule
    std::uint32_t steps = 0;  ///< of it that are done
    std::uint32_t quiet = 0;  ///< of the last steps, those below the stop criterion
    std::uint32_t stuck = 0;  ///< of the last steps, those in which next to nothing moved
};

void save(StateWriter& out, const RunTotals& totals);
/// Names of repair classes stay as they are: the strategies tell them.
void load(StateReader& in, RunTotals& totals);

void save(StateWriter& out, const Strategies& strategies);
void load(StateReader& in, Strategies& strategies);

}  // namespace dsc::run
