// Counts the requests of refinements and follows their vertices.
#include "refinement_watch.hpp"

#include <algorithm>
#include <limits>

#include <dsc/base/error.hpp>

namespace dsc::run {
namespace {

/// Number of vertices of the view with births from `first` up to `last`, without it.
std::uint64_t vertices_between(const surface::SurfaceView& view, std::uint32_t first,
                               std::uint32_t last) {
    const auto begin = std::lower_bound(view.births.begin(), view.births.end(), first);
    return static_cast<std::uint64_t>(std::lower_bound(begin, view.births.end(), last) - begin);
}

}  // namespace

RefinementWatch::RefinementWatch(const Experiment& experiment, const Strategies* strategies)
    : last_steps_(std::numeric_limits<std::size_t>::max()) {
    const auto given = [strategies](std::size_t item) {
        return strategies != nullptr && item < strategies->refinements.size() &&
               strategies->refinements[item] != nullptr;
    };
    for (std::size_t i = 0; i < experiment.schedule.size(); ++i) {
        if (experiment.schedule[i].steps) last_steps_ = i;
        if (experiment.schedule[i].refine.empty() && !given(i)) continue;
        figures_.emplace_back().item = i;
    }
}

std::size_t RefinementWatch::index_of(std::size_t item) const {
    const auto found = std::find_if(figures_.begin(), figures_.end(),
                                    [item](const RefinementFigures& f) { return f.item == item; });
    return static_cast<std::size_t>(found - figures_.begin());
}

void RefinementWatch::begin(std::uint32_t next_birth) {
    running_ = {};
    first_birth_ = next_birth;
}

void RefinementWatch::add(std::size_t requested, std::size_t committed) {
    running_.requested += requested;
    running_.committed += committed;
}

void RefinementWatch::end(std::size_t item, std::uint64_t steps, const surface::SurfaceView& view) {
    constexpr std::uint32_t no_bound = std::numeric_limits<std::uint32_t>::max();
    running_.made = vertices_between(view, first_birth_, no_bound);
    since_step_.requested += running_.requested;
    since_step_.committed += running_.committed;
    since_step_.made += running_.made;
    const std::size_t index = index_of(item);
    RefinementFigures& sums = figures_[index];
    ++sums.calls;
    sums.requested += running_.requested;
    sums.committed += running_.committed;
    sums.made += running_.made;
    const std::uint32_t last = view.births.empty() ? first_birth_ : view.births.back() + 1;
    watched_.push_back({index, steps, running_.made, first_birth_, std::max(last, first_birth_)});
}

void RefinementWatch::skip(std::size_t item) { ++figures_[index_of(item)].skipped; }

std::optional<RefinementRow> RefinementWatch::row(std::uint64_t steps,
                                                  const surface::SurfaceView& view) {
    if (figures_.empty()) return std::nullopt;
    RefinementRow row = since_step_;
    since_step_ = {};
    for (const Watched& w : watched_) {
        if (w.step + refinement_watch_steps > steps) continue;
        const std::uint64_t present = vertices_between(view, w.first, w.last);
        row.present = row.present.value_or(0.0) + static_cast<double>(present);
        figures_[w.item].followed += w.made;
        figures_[w.item].present += present;
    }
    std::erase_if(watched_,
                  [steps](const Watched& w) { return w.step + refinement_watch_steps <= steps; });
    return row;
}

void RefinementWatch::save(StateWriter& out) const {
    out.list(figures_);
    out.list(watched_);
    for (const std::uint64_t sum : {since_step_.requested, since_step_.committed, since_step_.made,
                                    running_.requested, running_.committed})
        out.value(sum);
    out.value(first_birth_);
}

void RefinementWatch::load(StateReader& in) {
    const std::size_t count = figures_.size();
    in.list(figures_);
    in.list(watched_);
    for (std::uint64_t* sum : {&since_step_.requested, &since_step_.committed, &since_step_.made,
                               &running_.requested, &running_.committed})
        in.value(*sum);
    in.value(first_birth_);
    const bool fits = std::all_of(watched_.begin(), watched_.end(),
                                  [count](const Watched& w) { return w.item < count; });
    if (figures_.size() != count || !fits)
        throw IoError("state.damaged", "saved state", "", "the refinements do not fit the schedule",
                      "start the run again");
}

}  // namespace dsc::run
