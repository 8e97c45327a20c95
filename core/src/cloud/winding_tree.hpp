#pragma once
// A kd-tree of clusters over points in float, for the winding field.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dsc::cloud {

/// Points begin..end-1 of the tree's order. A node's first child follows it.
struct ClusterNode {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t second = 0;       ///< its second child; 0 for a leaf
    std::array<float, 3> centre{};  ///< weighted mean of its points
    float radius = 0.0F;            ///< largest distance of a point from the centre

    bool leaf() const { return second == 0; }
    std::uint32_t size() const { return end - begin; }
};

/// Nodes are halved at the median along the longest axis of their box, ties by index, down to
/// `leaf_size` points.
class ClusterTree {
public:
    /// `weights`: one per point, all positive, or empty for equal ones. At least one point, all
    /// finite. [setup]
    ClusterTree(std::vector<std::array<float, 3>> points, std::span<const float> weights,
                std::size_t leaf_size);

    const std::vector<ClusterNode>& nodes() const { return nodes_; }
    /// Indices of `nodes()` without children, in the order of their points.
    const std::vector<std::uint32_t>& leaves() const { return leaves_; }
    /// Original index of the n-th point in the tree's order.
    const std::vector<std::uint32_t>& order() const { return order_; }
    /// Coordinates along one axis, in the tree's order.
    const std::vector<float>& coordinates(std::size_t axis) const { return coordinates_[axis]; }

private:
    struct Entry {
        std::array<float, 3> point;
        std::uint32_t index;
    };
    void divide(std::vector<Entry>& entries, std::size_t begin, std::size_t end,
                std::size_t leaf_size);
    void measure(std::span<const float> weights);

    std::vector<ClusterNode> nodes_;
    std::vector<std::uint32_t> leaves_;
    std::vector<std::uint32_t> order_;
    std::array<std::vector<float>, 3> coordinates_;
};

/// Whether a cluster, as seen from all points of a group of targets, is small enough to be used as
/// one source.
inline bool far_enough(const ClusterNode& cluster, const ClusterNode& targets, float distance,
                       float opening) {
    return cluster.size() > 3 && cluster.radius < opening * (distance - targets.radius);
}

}  // namespace dsc::cloud
