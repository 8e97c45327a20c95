#pragma once
// A small table from tets to their places in a list. The table of a star fits into the first-level
// cache; a mark per tet of the mesh would not. If each thread has its own table, several threads
// can walk through the same complex.

#include <cstdint>
#include <vector>

namespace dsc::mesh {

/// Open addressing, at most half full. Reuse one object: clear() costs nothing, and memory grows
/// only with the longest list.
class TetIndex {
public:
    static constexpr std::uint32_t absent = 0xffffffffU;

    TetIndex() : keys_(256, 0), places_(256, 0) {}

    void clear() {
        size_ = 0;
        stamp_ += stamp_step;
        if (stamp_ != 0) return;
        keys_.assign(keys_.size(), 0);
        stamp_ = stamp_step;
    }
    std::uint32_t size() const { return size_; }

    /// Gives t the next place. False if t already has a place.
    bool insert(std::uint32_t t) {
        // Without a branch on whether t is new, because the processor cannot guess that.
        const std::size_t at = slot_of(t);
        const bool is_new = keys_[at] != (stamp_ | t);
        keys_[at] = stamp_ | t;
        places_[at] = is_new ? size_ : places_[at];
        size_ += is_new ? 1 : 0;
        if (2 * size_ > keys_.size()) grow();
        return is_new;
    }
    /// Place of t; `absent` if it has none.
    std::uint32_t find(std::uint32_t t) const {
        const std::size_t at = slot_of(t);
        return keys_[at] == (stamp_ | t) ? places_[at] : absent;
    }
    bool contains(std::uint32_t t) const { return keys_[slot_of(t)] == (stamp_ | t); }

private:
    // A key is the tet's id plus the stamp of its list; keys with another stamp are free slots.
    static constexpr std::uint64_t stamp_step = std::uint64_t{1} << 32U;

    // The slot of t, or the free slot for it. Multiplication by 2^32 / golden ratio spreads
    // neighbouring ids.
    std::size_t slot_of(std::uint32_t t) const {
        const std::size_t mask = keys_.size() - 1;
        std::size_t at = ((t * std::uint64_t{0x9e3779b1U}) >> 12U) & mask;
        while (keys_[at] >= stamp_ && keys_[at] != (stamp_ | t)) at = (at + 1) & mask;
        return at;
    }
    void grow();

    std::vector<std::uint64_t> keys_;  // a power of two
    std::vector<std::uint32_t> places_;
    std::uint64_t stamp_ = stamp_step;
    std::uint32_t size_ = 0;
};

}  // namespace dsc::mesh
