#pragma once
// What the refinements of a run have done, and how many of their vertices are still there later.

#include <cstdint>
#include <vector>

#include <dsc/base/state.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/figures.hpp>
#include <dsc/run/metrics.hpp>
#include <dsc/run/simulation.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::run {

/// Belongs to one run. A vertex is known by its birth id: a refinement has made the vertices that
/// were born while it ran and lie on the interface when it ends.
class RefinementWatch {
public:
    /// `strategies`: a program may give refinements that the experiment does not name; null: those
    /// of the experiment.
    explicit RefinementWatch(const Experiment& experiment, const Strategies* strategies = nullptr);

    /// Whether this item comes after the last step of the schedule. A schedule without steps has no
    /// last step.
    bool comes_too_late(std::size_t item) const { return item > last_steps_; }

    /// A refinement begins; vertices get births from `next_birth` on. [step]
    void begin(std::uint32_t next_birth);
    /// Counts requests of the refinement that runs. [step]
    void add(std::size_t requested, std::size_t committed);
    /// The refinement of the item ends after `steps` completed steps. [step]
    void end(std::size_t item, std::uint64_t steps, const surface::SurfaceView& view);
    /// Counts a refinement that was skipped. [step]
    void skip(std::size_t item);

    /// The figures for the row of the completed step `steps`; empty without refinements. [step]
    std::optional<RefinementRow> row(std::uint64_t steps, const surface::SurfaceView& view);
    /// One entry per item of the schedule with a refinement.
    const std::vector<RefinementFigures>& figures() const { return figures_; }

    void save(StateWriter& out) const;
    void load(StateReader& in);

private:
    // A refinement whose vertices are counted again later: births from `first` up to `last`.
    struct Watched {
        std::uint64_t item;  // index of figures_
        std::uint64_t step;
        std::uint64_t made;
        std::uint32_t first, last;
    };
    std::size_t index_of(std::size_t item) const;

    std::size_t last_steps_;  // the last item with steps
    std::vector<RefinementFigures> figures_;
    std::vector<Watched> watched_;
    RefinementRow since_step_;  // sums of the refinements after the last step
    RefinementRow running_;
    std::uint32_t first_birth_ = 0;  // of the refinement that runs
};

}  // namespace dsc::run
