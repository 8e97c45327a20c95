// Follows the vertices of the interface from step to step by their birth ids.
#include "vertex_history.hpp"

#include <algorithm>

#include <dsc/base/error.hpp>

namespace dsc::run {

void VertexHistory::note_births(std::uint32_t next_birth, std::uint64_t steps) {
    if (!generations_.empty() && next_birth <= generations_.back().end) return;
    if (!generations_.empty() && generations_.back().step == steps) {
        generations_.back().end = next_birth;
    } else {
        generations_.push_back({steps, next_birth});
    }
}

void VertexHistory::begin_step(const surface::SurfaceView& view) {
    births_ = view.births;
    positions_ = view.positions;
}

void VertexHistory::end_step(std::span<const std::uint32_t> not_arrived) {
    not_arrived_.assign(not_arrived.begin(), not_arrived.end());
    std::sort(not_arrived_.begin(), not_arrived_.end());
    not_arrived_.erase(std::unique(not_arrived_.begin(), not_arrived_.end()), not_arrived_.end());
}

void VertexHistory::apply(std::uint64_t steps, surface::SurfaceView& view) const {
    const std::size_t count = view.vertex_count();
    view.previous_positions = view.positions;
    view.arrived.assign(count, 1);
    view.age.resize(count);
    // All lists are in the order of the births.
    std::size_t old = 0, late = 0, generation = 0;
    for (std::size_t v = 0; v < count; ++v) {
        const std::uint32_t birth = view.births[v];
        while (old < births_.size() && births_[old] < birth) ++old;
        if (old < births_.size() && births_[old] == birth)
            view.previous_positions[v] = positions_[old];
        while (late < not_arrived_.size() && not_arrived_[late] < birth) ++late;
        if (late < not_arrived_.size() && not_arrived_[late] == birth) view.arrived[v] = 0;
        while (generation < generations_.size() && generations_[generation].end <= birth)
            ++generation;
        view.age[v] = generation < generations_.size()
                          ? static_cast<std::uint32_t>(steps - generations_[generation].step)
                          : 0;
    }
}

void VertexHistory::save(StateWriter& out) const {
    out.list(generations_);
    out.list(births_);
    out.list(positions_);
    out.list(not_arrived_);
}

void VertexHistory::load(StateReader& in) {
    in.list(generations_);
    in.list(births_);
    in.list(positions_);
    in.list(not_arrived_);
    if (births_.size() != positions_.size())
        throw IoError("state.damaged", "saved state", "",
                      "the previous positions do not fit the vertices", "start the run again");
}

}  // namespace dsc::run
