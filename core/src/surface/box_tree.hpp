#pragma once
// A binary tree of boxes over items, for queries in double precision.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::surface {

/// Built once; can be read from any thread. Its shape depends only on the boxes.
class BoxTree {
public:
    explicit BoxTree(const std::vector<Box3>& boxes) : items_(boxes.size()) {
        std::iota(items_.begin(), items_.end(), 0U);
        nodes_.reserve(boxes.size() / 2 + 1);
        if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
    }

    struct Best {
        double squared = std::numeric_limits<double>::infinity();
        std::uint32_t item = 0;
    };

    /// The item with the least squared_distance(item); of equal ones the lowest. The function must
    /// not return less than the squared distance from p to the item's box, except for rounding.
    template <class SquaredDistance>
    Best nearest(const Vec3& p, SquaredDistance&& squared_distance) const {
        Best best;
        if (nodes_.empty()) return best;
        struct Entry {
            std::uint32_t node;
            double squared;
        };
        Entry stack[max_depth];
        std::size_t size = 0;
        stack[size++] = {0, nodes_[0].squared_distance(p)};
        while (size > 0) {
            const Entry top = stack[--size];
            // The margin prevents rounding from excluding an equally near item with a lower index.
            if (top.squared > best.squared * (1.0 + 1e-14)) continue;
            const Node& node = nodes_[top.node];
            if (node.count > 0) {
                for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                    const double squared = squared_distance(items_[k]);
                    if (squared < best.squared ||
                        (squared == best.squared && items_[k] < best.item)) {
                        best = {squared, items_[k]};
                    }
                }
                continue;
            }
            Entry near{top.node + 1, nodes_[top.node + 1].squared_distance(p)};
            Entry far{node.first, nodes_[node.first].squared_distance(p)};
            if (far.squared < near.squared) std::swap(near, far);
            stack[size++] = far;
            stack[size++] = near;
        }
        return best;
    }

    /// Calls item(i) for all items below nodes for which meets(box) is true, in a fixed order.
    template <class Meets, class Item>
    void visit(Meets&& meets, Item&& item) const {
        if (nodes_.empty()) return;
        std::uint32_t stack[max_depth];
        std::size_t size = 0;
        stack[size++] = 0;
        while (size > 0) {
            const std::uint32_t at = stack[--size];
            const Node& node = nodes_[at];
            if (!meets(node.box)) continue;
            if (node.count > 0) {
                for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
                    item(items_[k]);
                continue;
            }
            stack[size++] = node.first;
            stack[size++] = at + 1;
        }
    }

private:
    static constexpr std::size_t max_depth = 80;  // enough for halving 2^32 items with one sibling
                                                  // per level
    static constexpr std::uint32_t leaf_size = 4;

    struct Node {
        Box3 box;
        std::uint32_t first = 0;  ///< leaf: its first item; otherwise the second child; the first
                                  ///< child follows the node
        std::uint32_t count = 0;  ///< number of items of a leaf; 0 for an inner node
        double squared_distance(const Vec3& p) const {
            return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).squaredNorm();
        }
    };

    std::uint32_t build(const std::vector<Box3>& boxes, std::uint32_t begin, std::uint32_t end) {
        const auto index = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
        Box3 box, centres;
        for (std::uint32_t k = begin; k < end; ++k) {
            const Box3& item = boxes[items_[k]];
            box.low = box.low.cwiseMin(item.low);
            box.high = box.high.cwiseMax(item.high);
            centres.extend(item.centre());
        }
        nodes_[index].box = box;
        if (end - begin <= leaf_size) {
            nodes_[index].first = begin;
            nodes_[index].count = end - begin;
            return index;
        }
        Eigen::Index axis = 0;
        centres.size().maxCoeff(&axis);
        const std::uint32_t middle = begin + (end - begin) / 2;
        const auto before = [&](std::uint32_t i, std::uint32_t j) {
            const double a = boxes[i].low[axis] + boxes[i].high[axis],
                         b = boxes[j].low[axis] + boxes[j].high[axis];
            return a != b ? a < b : i < j;
        };
        std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                         before);
        build(boxes, begin, middle);
        const std::uint32_t second = build(boxes, middle, end);
        nodes_[index].first = second;
        return index;
    }

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> items_;
};

}  // namespace dsc::surface
