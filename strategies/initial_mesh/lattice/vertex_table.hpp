#pragma once
// Numbers of lattice points, in the order in which they are first asked for.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cell_set.hpp"

namespace dsc::strategies::lattice {

/// Open addressing; grows by doubling. Coordinates are in [0, 2^21).
class VertexTable {
public:
    VertexTable() : slots_(1024, Slot{unused, 0}) {}

    /// Number of the point, a new one at its first call.
    std::uint32_t number(const Cell& x) {
        if (2 * points_.size() > slots_.size()) grow();
        const std::uint64_t key = static_cast<std::uint64_t>(x[0]) | static_cast<std::uint64_t>(x[1]) << 21U |
                                  static_cast<std::uint64_t>(x[2]) << 42U;
        Slot& slot = find(key);
        if (slot.key == unused) {
            slot = {key, static_cast<std::uint32_t>(points_.size())};
            points_.push_back(x);
        }
        return slot.number;
    }
    /// All points by their numbers.
    const std::vector<Cell>& points() const { return points_; }

private:
    struct Slot {
        std::uint64_t key;
        std::uint32_t number;
    };
    static constexpr std::uint64_t unused = ~std::uint64_t{0};

    Slot& find(std::uint64_t key) {
        const std::size_t mask = slots_.size() - 1;
        // Fibonacci hashing: the upper bits of the product depend on all bits of the key.
        std::size_t at = static_cast<std::size_t>(key * 0x9e3779b97f4a7c15U >> 24U) & mask;
        while (slots_[at].key != unused && slots_[at].key != key) at = (at + 1) & mask;
        return slots_[at];
    }
    void grow() {
        std::vector<Slot> old(2 * slots_.size(), Slot{unused, 0});
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.key != unused) find(slot.key) = slot;
        }
    }

    std::vector<Slot> slots_;
    std::vector<Cell> points_;
};

}  // namespace dsc::strategies::lattice
