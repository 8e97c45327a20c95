// The nearest cloud point of each view vertex.
#include "nearest_points.hpp"

namespace dsc::run {
namespace {

constexpr std::size_t searched_block = 1024;  // vertices

}  // namespace

void NearestPoints::refresh(const surface::SurfaceView& view, const cloud::NearestSearch& search,
                            Workers* workers) {
    before_.swap(found_);
    found_.resize(view.vertex_count());
    moved_.clear();
    // Both lists of births are ascending.
    std::size_t old = 0;
    for (std::uint32_t v = 0; v < view.vertex_count(); ++v) {
        while (old < births_.size() && births_[old] < view.births[v]) ++old;
        const bool known = old < births_.size() && births_[old] == view.births[v] &&
                           positions_[old] == view.positions[v];
        if (known) {
            found_[v] = before_[old];
        } else {
            moved_.push_back(v);
        }
    }
    for_blocks(workers, moved_.size(), searched_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            found_[moved_[i]] = search.nearest(view.positions[moved_[i]]);
    });
    births_ = view.births;
    positions_ = view.positions;
}

}  // namespace dsc::run
