#pragma once
// A set of cells of a cubic array, one bit a cell.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dsc::mesh::lattice {

/// Indices x, y, z of a cell; -1 and `side` name the cells beyond the box.
using Cell = std::array<int, 3>;

/// Rows run along x and are packed into words, so that whole sets are grown and coarsened a word at a time.
class CellSet {
public:
    /// An empty set of the side^3 cells.
    explicit CellSet(unsigned side);

    unsigned side() const { return side_; }
    /// False beyond the box.
    bool has(const Cell& cell) const {
        const auto side = static_cast<int>(side_);
        if (cell[0] < 0 || cell[1] < 0 || cell[2] < 0 || cell[0] >= side || cell[1] >= side ||
            cell[2] >= side) {
            return false;
        }
        return (words_[word_of(cell)] >> (static_cast<unsigned>(cell[0]) % 64U) & 1U) != 0;
    }
    void add(const Cell& cell) {
        words_[word_of(cell)] |= std::uint64_t{1} << (static_cast<unsigned>(cell[0]) % 64U);
    }
    std::size_t count() const;

    /// With all cells that share an edge with one of the set's, `layers` times.
    CellSet grown(unsigned layers) const;
    /// The cells of twice the size that hold at least one of the set's; the side must be even.
    CellSet parents() const;

private:
    std::size_t word_of(const Cell& c) const {
        return (static_cast<std::size_t>(c[2]) * side_ + static_cast<std::size_t>(c[1])) * row_ +
               static_cast<std::size_t>(c[0]) / 64U;
    }
    std::vector<std::uint64_t> spread(const std::vector<std::uint64_t>& from, unsigned axis) const;
    void grow();

    unsigned side_;
    std::size_t row_;  // words of a row
    std::vector<std::uint64_t> words_;
};

}  // namespace dsc::mesh::lattice
