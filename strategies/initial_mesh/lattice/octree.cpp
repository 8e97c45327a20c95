#include "octree.hpp"

#include <cmath>

namespace dsc::strategies::lattice {
namespace {

// The finest cells whose tets may have different labels, found from the top down.
class Crossed {
public:
    Crossed(const Frame& frame, std::span<const mesh::Shape> shapes)
        : frame_(frame), shapes_(shapes), cells_(frame.side) {}

    void search(unsigned level, const Cell& cell) {
        const Cell low = corner_of(level, cell);
        const int half = edge_of(level) / 2;
        const Vec3 centre = frame_.point({low[0] + half, low[1] + half, low[2] + half});
        // A little more than half the diagonal: a surface through a corner counts.
        const double radius = (1 + 1e-9) * std::sqrt(3.0) * frame_.length * half / frame_.units;
        if (mesh::same_label_within(shapes_, centre, radius)) return;
        if (level == 0) return cells_.add(cell);
        for (int n = 0; n < 8; ++n)
            search(level - 1, {2 * cell[0] + (n & 1), 2 * cell[1] + (n >> 1 & 1), 2 * cell[2] + (n >> 2)});
    }
    const CellSet& cells() const { return cells_; }

private:
    const Frame& frame_;
    std::span<const mesh::Shape> shapes_;
    CellSet cells_;
};

}  // namespace

Octree::Octree(const Frame& frame, unsigned top, std::span<const mesh::Shape> shapes, unsigned layers,
               unsigned coarse_layers) {
    divided_.emplace_back(frame.side);
    if (top == 0) return;
    Crossed crossed(frame, shapes);
    const auto roots = static_cast<int>(frame.side >> top);
    for (int k = 0; k < roots; ++k) {
        for (int j = 0; j < roots; ++j) {
            for (int i = 0; i < roots; ++i) crossed.search(top, {i, j, k});
        }
    }
    divided_.push_back(crossed.cells().grown(layers - 1).parents());
    while (divided_.size() <= top) divided_.push_back(divided_.back().grown(coarse_layers).parents());
}

bool Octree::leaf(unsigned level, const Cell& cell) const {
    if (divided(level, cell)) return false;
    return level == top() || divided(level + 1, {cell[0] >> 1, cell[1] >> 1, cell[2] >> 1});
}

std::size_t Octree::leaves() const {
    const std::size_t roots = side(top());
    std::size_t sum = roots * roots * roots;
    for (const CellSet& set : divided_) sum += 7 * set.count();
    return sum;
}

}  // namespace dsc::strategies::lattice
