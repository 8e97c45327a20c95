#pragma once
// How long a run will go on, from what its steps have cost so far.

#include <cstdint>
#include <dsc/run/experiment.hpp>
#include <optional>
#include <vector>

namespace dsc::app {

/// A step costs so much for each interface vertex; refinements make more of them, each by the same factor. Both are learned
/// from the steps behind. Of the last costs the cheaper ones count: steps are dear where a run or a series begins, and
/// become cheap as the surface settles.
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
    std::vector<std::uint64_t> refinements_;  ///< the step that each comes right after, ascending; 0: before the first one
    std::optional<std::uint64_t> step_;
    double vertices_ = 0, seconds_ = 0;
    std::vector<double> costs_;         ///< seconds a vertex of the last steps
    double growths_ = 0, growth_ = 0;   ///< refinements seen, and the sum of the logarithms of their factors
};

}  // namespace dsc::app
