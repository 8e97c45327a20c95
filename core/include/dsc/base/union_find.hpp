#pragma once
// Disjoint sets of indices.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dsc {

/// Disjoint sets. The root of a set is its smallest index, so it does not depend on the order of
/// the unions.
class UnionFind {
public:
    /// Each index is a separate set at first. [parallel]
    explicit UnionFind(std::size_t count) : parent_(count) {
        for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
    }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    /// Joins the two sets and returns the root of the result.
    std::uint32_t join(std::uint32_t a, std::uint32_t b) {
        if (parent_[a] == parent_[b]) return find(a);
        a = find(a);
        b = find(b);
        if (b < a) std::swap(a, b);
        parent_[b] = a;
        return a;
    }
    std::size_t size() const { return parent_.size(); }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace dsc
