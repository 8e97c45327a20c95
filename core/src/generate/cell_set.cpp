// A set of cells of a cubic array: bricks of 4 x 4 x 4 cells in a hash table.
#include "generate/cell_set.hpp"

#include <bit>

namespace dsc::generate::lattice {
namespace {

// Cells of a brick whose index along an axis is 0.
constexpr std::array<std::uint64_t, 3> first_cells = {0x1111111111111111U, 0x000f000f000f000fU,
                                                      0xffffU};

}  // namespace

std::size_t CellSet::count() const {
    std::size_t sum = 0;
    for (const Brick& b : slots_) sum += static_cast<std::size_t>(std::popcount(b.cells));
    return sum;
}

void CellSet::add(const Cell& brick, std::uint64_t cells) {
    std::size_t at = slot_of(key_of(brick));
    if (slots_[at].key == unused) {
        if (2 * (bricks_ + 1) > slots_.size()) {
            std::vector<Brick> old(2 * slots_.size(), Brick{unused, 0});
            old.swap(slots_);
            for (const Brick& b : old) {
                if (b.key != unused) slots_[slot_of(b.key)] = b;
            }
            at = slot_of(key_of(brick));
        }
        slots_[at].key = key_of(brick);
        ++bricks_;
    }
    slots_[at].cells |= cells;
}

void CellSet::add(const CellSet& other) {
    for (const Brick& b : other.slots_) {
        if (b.key != unused) add(brick_of(b.key), b.cells);
    }
}

// The set with its neighbours along an axis; the cells at both ends of a row have one neighbour.
CellSet CellSet::spread(unsigned axis) const {
    const unsigned step = 1U << 2U * axis;
    const std::uint64_t first = first_cells[axis], last = first << 3U * step;
    CellSet out = *this;
    for (const Brick& b : slots_) {
        if (b.key == unused) continue;
        Cell at = brick_of(b.key);
        // Only the cells of the last brick that are inside the box count.
        const unsigned width = side_ - 4U * static_cast<unsigned>(at[axis]);
        std::uint64_t inner = (b.cells & ~last) << step | (b.cells & ~first) >> step;
        if (width < 4) inner &= ~(first << width * step);
        out.add(at, inner);
        if ((b.cells & first) != 0 && at[axis] > 0) {
            --at[axis];
            out.add(at, (b.cells & first) << 3U * step);
            ++at[axis];
        }
        if ((b.cells & last) != 0 && width > 4) {
            ++at[axis];
            out.add(at, (b.cells & last) >> 3U * step);
        }
    }
    return out;
}

CellSet CellSet::grown(unsigned layers) const {
    CellSet out = *this;
    for (unsigned n = 0; n < layers && n < side_; ++n) {
        // Over edges: neighbours along two axes, for every pair of them.
        const CellSet x = out.spread(0), y = out.spread(1);
        out = x.spread(1);
        out.add(x.spread(2));
        out.add(y.spread(2));
    }
    return out;
}

CellSet CellSet::parents() const {
    CellSet out(side_ / 2);
    for (const Brick& b : slots_) {
        if (b.key == unused) continue;
        std::uint64_t w = b.cells;
        w |= w >> 1U;
        w |= w >> 4U;
        w |= w >> 16U;
        const Cell at = brick_of(b.key);
        std::uint64_t cells = 0;
        for (int n = 0; n < 8; ++n) {
            const int i = n & 1, j = n >> 1 & 1, k = n >> 2;
            if ((w >> static_cast<unsigned>(2 * i + 8 * j + 32 * k) & 1U) == 0) continue;
            cells |= bit_of({2 * at[0] + i, 2 * at[1] + j, 2 * at[2] + k});
        }
        out.add({at[0] >> 1, at[1] >> 1, at[2] >> 1}, cells);
    }
    return out;
}

}  // namespace dsc::generate::lattice
