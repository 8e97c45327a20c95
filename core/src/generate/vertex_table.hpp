#pragma once
// Numbers lattice points in the order of their first use.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "generate/cell_set.hpp"

namespace dsc::generate::lattice {

/// Open addressing; grows by doubling. Recently used points are found in a small table that stays
/// in the processor's cache. Coordinates are in [0, 2^21).
class VertexTable {
public:
    VertexTable() : slots_(1024, Slot{unused, 0}), recent_(1U << recent_bits, Slot{unused, 0}) {}

    /// Number of the point; the first call with a point gives it a new number.
    std::uint32_t number(const Cell& x) {
        const std::uint64_t key = key_of(x);
        Slot& seen = recent_[static_cast<std::size_t>(spread(key) >> (64U - recent_bits))];
        if (seen.key == key) return seen.number;
        if (2 * points_.size() > slots_.size()) grow();
        Slot& slot = find(key);
        if (slot.key == unused) {
            slot = {key, static_cast<std::uint32_t>(points_.size())};
            points_.push_back(x);
        }
        seen = slot;
        return slot.number;
    }
    /// Number of a point that the table contains.
    std::uint32_t known(const Cell& x) const { return slots_[slot_of(key_of(x))].number; }
    /// All points, in the order of their numbers.
    const std::vector<Cell>& points() const { return points_; }

private:
    friend class KnownNumbers;
    struct Slot {
        std::uint64_t key;
        std::uint32_t number;
    };
    static constexpr std::uint64_t unused = ~std::uint64_t{0};
    static constexpr unsigned recent_bits = 13;

    // Fibonacci hashing: the upper bits of the product depend on all bits of the key.
    static std::uint64_t spread(std::uint64_t key) { return key * 0x9e3779b97f4a7c15U; }

    static std::uint64_t key_of(const Cell& x) {
        return static_cast<std::uint64_t>(x[0]) | static_cast<std::uint64_t>(x[1]) << 21U |
               static_cast<std::uint64_t>(x[2]) << 42U;
    }
    std::size_t slot_of(std::uint64_t key) const {
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = static_cast<std::size_t>(spread(key) >> 24U) & mask;
        while (slots_[at].key != unused && slots_[at].key != key) at = (at + 1) & mask;
        return at;
    }
    Slot& find(std::uint64_t key) { return slots_[slot_of(key)]; }
    void grow() {
        std::vector<Slot> old(2 * slots_.size(), Slot{unused, 0});
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.key != unused) find(slot.key) = slot;
        }
    }

    std::vector<Slot> slots_, recent_;
    std::vector<Cell> points_;
};

/// Reads the numbers of a table that contains all points; each thread needs its own reader.
class KnownNumbers {
public:
    explicit KnownNumbers(const VertexTable& table)
        : table_(table), recent_(1U << recent_bits, VertexTable::Slot{VertexTable::unused, 0}) {}

    /// Number of a point of the table.
    std::uint32_t number(const Cell& x) {
        const std::uint64_t key = VertexTable::key_of(x);
        VertexTable::Slot& seen =
            recent_[static_cast<std::size_t>(VertexTable::spread(key) >> (64U - recent_bits))];
        if (seen.key != key) seen = table_.slots_[table_.slot_of(key)];
        return seen.number;
    }

private:
    static constexpr unsigned recent_bits = 11;

    const VertexTable& table_;
    std::vector<VertexTable::Slot> recent_;
};

}  // namespace dsc::generate::lattice
