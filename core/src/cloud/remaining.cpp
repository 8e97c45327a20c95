// Keeps neighbours up to date while points are removed.
#include "remaining.hpp"

#include <algorithm>
#include <utility>

#include <dsc/base/median.hpp>
#include <dsc/cloud/search.hpp>

namespace dsc::cloud {

namespace {

constexpr std::size_t query_block = 512;

}  // namespace

Remaining::Remaining(std::span<const Vec3> points, Workers* workers)
    : points_(points),
      present_(points.size(), 1),
      count_(points.size()),
      neighbours_(find_neighbours(points, remaining_neighbours, workers)) {}

void Remaining::remove(const std::vector<unsigned char>& gone, Workers* workers) {
    if (order_.empty()) order_ = spatial_order(points_);
    std::vector<std::uint32_t> left;
    for (const std::uint32_t i : order_) {
        if (gone[i] != 0) present_[i] = 0;
        if (has(i)) left.push_back(i);
    }
    order_ = std::move(left);
    count_ = order_.size();
    std::vector<Vec3> ordered(count_);
    std::vector<std::uint32_t> stale;  // positions in the order
    for (std::size_t n = 0; n < count_; ++n) {
        ordered[n] = points_[order_[n]];
        const auto around = neighbours_.of(order_[n]);
        if (std::any_of(around.begin(), around.end(), [&](std::uint32_t j) { return !has(j); }))
            stale.push_back(static_cast<std::uint32_t>(n));
    }
    const NearestSearch search(ordered);
    for_blocks(workers, stale.size(), query_block, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour> found;
        for (std::size_t q = begin; q < end; ++q) {
            const std::uint32_t place = stale[q], i = order_[place];
            search.k_nearest(ordered[place], neighbours_.each + 1, found);
            std::size_t kept = 0;
            for (const Neighbour& n : found) {
                if (n.index == place || kept == neighbours_.each) continue;
                neighbours_.index[i * neighbours_.each + kept] = order_[n.index];
                if (++kept == neighbours_.reached()) neighbours_.reach[i] = n.distance;
            }
        }
    });
}

double Remaining::median_reach() const {
    std::vector<double> reach;
    reach.reserve(count_);
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (has(i)) reach.push_back(neighbours_.reach[i]);
    return median_of(std::move(reach));
}

}  // namespace dsc::cloud
