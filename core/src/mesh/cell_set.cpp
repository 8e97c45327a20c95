#include "mesh/cell_set.hpp"

#include <bit>

namespace dsc::mesh::lattice {
namespace {

// Bits 0, 2, 4, ... of a word, moved together into its lower half.
std::uint64_t even_bits(std::uint64_t w) {
    w &= 0x5555555555555555U;
    w = (w | w >> 1U) & 0x3333333333333333U;
    w = (w | w >> 2U) & 0x0f0f0f0f0f0f0f0fU;
    w = (w | w >> 4U) & 0x00ff00ff00ff00ffU;
    w = (w | w >> 8U) & 0x0000ffff0000ffffU;
    return (w | w >> 16U) & 0x00000000ffffffffU;
}

}  // namespace

CellSet::CellSet(unsigned side) : side_(side), row_((side + 63U) / 64U), words_(row_ * side * side, 0) {}

std::size_t CellSet::count() const {
    std::size_t sum = 0;
    for (const std::uint64_t w : words_) sum += static_cast<std::size_t>(std::popcount(w));
    return sum;
}

// Each word with the bits of its cells' neighbours along an axis; both ends of a row have one neighbour.
std::vector<std::uint64_t> CellSet::spread(const std::vector<std::uint64_t>& from, unsigned axis) const {
    std::vector<std::uint64_t> out = from;
    if (axis > 0) {
        // Along y a row's neighbours are a row away, along z a plane.
        const std::size_t stride = axis == 1 ? row_ : row_ * side_;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::size_t at = i / stride % side_;
            if (at > 0) out[i] |= from[i - stride];
            if (at + 1 < side_) out[i] |= from[i + stride];
        }
        return out;
    }
    const std::uint64_t last = side_ % 64U == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << (side_ % 64U)) - 1;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t at = i % row_;
        const std::uint64_t before = at > 0 ? from[i - 1] : 0, after = at + 1 < row_ ? from[i + 1] : 0;
        out[i] |= from[i] << 1U | before >> 63U | from[i] >> 1U | after << 63U;
        if (at + 1 == row_) out[i] &= last;
    }
    return out;
}

void CellSet::grow() {
    // Over edges: neighbours along two axes, for every pair of them.
    const auto x = spread(words_, 0), y = spread(words_, 1);
    const auto xy = spread(x, 1), xz = spread(x, 2), yz = spread(y, 2);
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] = xy[i] | xz[i] | yz[i];
}

CellSet CellSet::grown(unsigned layers) const {
    CellSet out = *this;
    for (unsigned n = 0; n < layers && n < side_; ++n) out.grow();
    return out;
}

CellSet CellSet::parents() const {
    CellSet out(side_ / 2);
    for (std::size_t z = 0; z < side_; ++z) {
        for (std::size_t y = 0; y < side_; ++y) {
            const std::uint64_t* from = &words_[(z * side_ + y) * row_];
            std::uint64_t* to = &out.words_[(z / 2 * out.side_ + y / 2) * out.row_];
            for (std::size_t i = 0; i < row_; ++i) {
                const std::uint64_t half = even_bits(from[i] | from[i] >> 1U);
                // An odd number of words leaves the upper half of the last one empty.
                if (half != 0) to[i / 2] |= half << (i % 2 == 0 ? 0U : 32U);
            }
        }
    }
    return out;
}

}  // namespace dsc::mesh::lattice
