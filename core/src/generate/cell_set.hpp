#pragma once
// A set of cells of a cubic array; it uses memory only where it has cells.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dsc::generate::lattice {

/// Indices x, y, z of a cell; -1 and `side` are outside the box.
using Cell = std::array<int, 3>;

/// Bricks of 4 x 4 x 4 cells, one word each, in a hash table with open addressing. Sets are grown
/// and coarsened brick by brick. Sides are below 2^21.
class CellSet {
public:
    /// An empty set in an array of side^3 cells.
    explicit CellSet(unsigned side) : side_(side), slots_(16, Brick{unused, 0}) {}

    unsigned side() const { return side_; }
    /// False outside the box.
    bool has(const Cell& cell) const {
        const auto side = static_cast<int>(side_);
        if (cell[0] < 0 || cell[1] < 0 || cell[2] < 0 || cell[0] >= side || cell[1] >= side ||
            cell[2] >= side) {
            return false;
        }
        return (slots_[slot_of(key_of({cell[0] >> 2, cell[1] >> 2, cell[2] >> 2}))].cells &
                bit_of(cell)) != 0;
    }
    void add(const Cell& cell) { add({cell[0] >> 2, cell[1] >> 2, cell[2] >> 2}, bit_of(cell)); }
    std::size_t count() const;

    /// The set with all cells that share an edge with one of its cells; repeated `layers` times.
    CellSet grown(unsigned layers) const;
    /// The cells of twice the size that contain at least one cell of the set; the side must be
    /// even.
    CellSet parents() const;

private:
    struct Brick {
        std::uint64_t key, cells;
    };
    static constexpr std::uint64_t unused = ~std::uint64_t{0};

    static std::uint64_t bit_of(const Cell& c) {
        return std::uint64_t{1} << static_cast<unsigned>((c[0] & 3) | (c[1] & 3) << 2 |
                                                         (c[2] & 3) << 4);
    }
    static std::uint64_t key_of(const Cell& brick) {
        return static_cast<std::uint64_t>(brick[0]) | static_cast<std::uint64_t>(brick[1]) << 21U |
               static_cast<std::uint64_t>(brick[2]) << 42U;
    }
    static Cell brick_of(std::uint64_t key) {
        constexpr std::uint64_t low = (1U << 21U) - 1;
        return {static_cast<int>(key & low), static_cast<int>(key >> 21U & low),
                static_cast<int>(key >> 42U)};
    }
    // The brick's slot, or the unused slot for it.
    std::size_t slot_of(std::uint64_t key) const {
        const std::size_t mask = slots_.size() - 1;
        // Fibonacci hashing: the upper bits of the product depend on all bits of the key.
        std::size_t at = static_cast<std::size_t>(key * 0x9e3779b97f4a7c15U >> 24U) & mask;
        while (slots_[at].key != unused && slots_[at].key != key) at = (at + 1) & mask;
        return at;
    }
    void add(const Cell& brick, std::uint64_t cells);
    void add(const CellSet& other);
    CellSet spread(unsigned axis) const;

    unsigned side_;
    std::size_t bricks_ = 0;
    std::vector<Brick> slots_;  // their number is a power of two; at most half of them are used
};

}  // namespace dsc::generate::lattice
