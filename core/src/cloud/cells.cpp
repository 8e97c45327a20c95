// Sorts the points of a scaled cloud into the cells of a grid.
#include "cells.hpp"

#include <algorithm>

namespace dsc::cloud {

namespace {

constexpr std::uint64_t no_key = ~std::uint64_t{0};

std::uint64_t key_of(const Vec3& p, double per_unit) {
    // The origin of the grid lies outside the cloud, away from planes of symmetry.
    std::uint64_t key = 0;
    for (int k = 0; k < 3; ++k)
        key = (key << 21U) | static_cast<std::uint64_t>((p[k] + 0.77) * per_unit);
    return key;
}

/// Numbers keys by their first appearance: an open hash table that doubles when it is half full.
class KeyNumbers {
public:
    explicit KeyNumbers(std::size_t expected) {
        std::size_t size = 64;
        while (size < 2 * expected) size *= 2;
        slots_.resize(size);
    }
    std::uint32_t number(std::uint64_t key) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        Slot& slot = find(key);
        if (slot.key == no_key) slot = {key, count_++};
        return slot.number;
    }
    std::size_t count() const { return count_; }

private:
    struct Slot {
        std::uint64_t key = no_key;
        std::uint32_t number = 0;
    };
    Slot& find(std::uint64_t key) {
        std::size_t at = ((key * 0x9E3779B97F4A7C15U) >> 20U) & (slots_.size() - 1);
        while (slots_[at].key != key && slots_[at].key != no_key)
            at = (at + 1) & (slots_.size() - 1);
        return slots_[at];
    }
    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& slot : old)
            if (slot.key != no_key) find(slot.key) = slot;
    }

    std::vector<Slot> slots_;
    std::uint32_t count_ = 0;
};

}  // namespace

Cells cells_of(std::span<const Vec3> points, double edge) {
    const double per_unit = 1.0 / std::max(edge, least_cell_edge);
    KeyNumbers numbers(1024);
    Cells cells;
    cells.of_point.reserve(points.size());
    for (const Vec3& p : points) {
        const std::uint32_t cell = numbers.number(key_of(p, per_unit));
        if (cell == cells.counts.size()) cells.counts.push_back(0);
        ++cells.counts[cell];
        cells.of_point.push_back(cell);
    }
    return cells;
}

std::size_t count_cells(std::span<const Vec3> points, double edge) {
    const double per_unit = 1.0 / std::max(edge, least_cell_edge);
    KeyNumbers numbers(1024);
    for (const Vec3& p : points) numbers.number(key_of(p, per_unit));
    return numbers.count();
}

std::vector<Vec3> means_of(const Cells& cells, std::span<const Vec3> values) {
    std::vector<Vec3> means(cells.counts.size(), Vec3::Zero());
    for (std::size_t i = 0; i < values.size(); ++i) means[cells.of_point[i]] += values[i];
    for (std::size_t c = 0; c < means.size(); ++c) means[c] /= static_cast<double>(cells.counts[c]);
    return means;
}

}  // namespace dsc::cloud
