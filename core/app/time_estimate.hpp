#pragma once
// Estimates the remaining time of a run from the cost of its steps so far.

#include <cstdint>
#include <optional>
#include <vector>

#include <dsc/run/experiment.hpp>

namespace dsc::app {

/// A step has a cost per interface vertex; each refinement multiplies their number by the same
/// factor. Both are measured in the steps done so far. Of the last costs the lower ones count:
/// steps are expensive where a run or a series begins, and become cheaper as the surface settles.
class TimeEstimate {
public:
    /// The steps and refinements of this schedule.
    explicit TimeEstimate(const std::vector<run::Series>& schedule);

    /// The state after a step, 0 before the first one, and the seconds since the run began.
    void add(std::uint64_t step, std::size_t interface_vertices, double seconds);
    /// Seconds from the last step on; nothing before the first one.
    std::optional<double> remaining() const;

private:
    std::uint64_t refinements_between(std::uint64_t from, std::uint64_t to) const;

    std::uint64_t planned_ = 0;               ///< steps
    std::vector<std::uint64_t> refinements_;  ///< the step after which each refinement comes,
                                              ///< ascending; 0: before the first step
    std::optional<std::uint64_t> step_;
    double vertices_ = 0, seconds_ = 0;
    std::vector<double> costs_;        ///< seconds per vertex in the last steps
    double growths_ = 0, growth_ = 0;  ///< refinements seen, and the sum of the logarithms of their
                                       ///< factors
};

}  // namespace dsc::app
