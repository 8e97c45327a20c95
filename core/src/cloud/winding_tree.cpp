// A kd-tree of clusters.
#include "winding_tree.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/base/release.hpp>

namespace dsc::cloud {

ClusterTree::ClusterTree(std::vector<std::array<float, 3>> points, std::span<const float> weights,
                         std::size_t leaf_size) {
    const std::size_t count = points.size();
    std::vector<Entry> entries(count);
    for (std::size_t i = 0; i < count; ++i) entries[i] = {points[i], static_cast<std::uint32_t>(i)};
    release(points);
    nodes_.reserve(4 * (count / leaf_size + 1));
    divide(entries, 0, count, leaf_size);
    order_.resize(count);
    for (std::vector<float>& axis : coordinates_) axis.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
        order_[n] = entries[n].index;
        for (std::size_t axis = 0; axis < 3; ++axis) coordinates_[axis][n] = entries[n].point[axis];
    }
    measure(weights);
}

void ClusterTree::divide(std::vector<Entry>& entries, std::size_t begin, std::size_t end,
                         std::size_t leaf_size) {
    const auto first = entries.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = entries.begin() + static_cast<std::ptrdiff_t>(end);
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    if (end - begin <= leaf_size) {
        // The order within the halves that the library leaves is arbitrary, so they are sorted.
        std::sort(first, last, [](const Entry& a, const Entry& b) { return a.index < b.index; });
        leaves_.push_back(self);
        return;
    }
    std::array<float, 3> low = first->point, high = first->point;
    for (auto entry = first; entry != last; ++entry)
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], entry->point[k]);
            high[k] = std::max(high[k], entry->point[k]);
        }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(first, entries.begin() + static_cast<std::ptrdiff_t>(middle), last,
                     [axis](const Entry& a, const Entry& b) {
                         return a.point[axis] < b.point[axis] ||
                                (a.point[axis] == b.point[axis] && a.index < b.index);
                     });
    divide(entries, begin, middle, leaf_size);
    nodes_[self].second = static_cast<std::uint32_t>(nodes_.size());
    divide(entries, middle, end, leaf_size);
}

void ClusterTree::measure(std::span<const float> weights) {
    // Leaves from their points, other nodes from their children, which come later in the list;
    // therefore from the last to the first.
    std::vector<std::array<double, 4>> sums(nodes_.size(), std::array<double, 4>{});
    for (std::size_t n = nodes_.size(); n-- > 0;) {
        ClusterNode& node = nodes_[n];
        std::array<double, 4>& sum = sums[n];
        if (node.leaf()) {
            for (std::size_t i = node.begin; i < node.end; ++i) {
                const double weight =
                    weights.empty() ? 1.0 : static_cast<double>(weights[order_[i]]);
                for (std::size_t k = 0; k < 3; ++k)
                    sum[k] += weight * static_cast<double>(coordinates_[k][i]);
                sum[3] += weight;
            }
        } else {
            for (std::size_t k = 0; k < 4; ++k) sum[k] = sums[n + 1][k] + sums[node.second][k];
        }
        for (std::size_t k = 0; k < 3; ++k) node.centre[k] = static_cast<float>(sum[k] / sum[3]);
        float square = 0.0F;
        for (std::size_t i = node.begin; i < node.end; ++i) {
            const float dx = coordinates_[0][i] - node.centre[0];
            const float dy = coordinates_[1][i] - node.centre[1];
            const float dz = coordinates_[2][i] - node.centre[2];
            square = std::max(square, dx * dx + dy * dy + dz * dz);
        }
        node.radius = std::sqrt(square);
    }
}

}  // namespace dsc::cloud
