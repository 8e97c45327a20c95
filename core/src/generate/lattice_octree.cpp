// The balanced octree of a lattice.
#include "generate/lattice_octree.hpp"

namespace dsc::generate::lattice {
namespace {

// Of a cell, in edges; slightly larger, so that a surface through a corner counts.
constexpr double half_diagonal = 0.8660254037844387 * (1 + 1e-9);

// The finest cells within a distance of places where tets may have different labels; the search
// goes from the top level down.
class Near {
public:
    Near(const Frame& frame, const SameWithin& same, double distance)
        : frame_(frame), same_(same), distance_(distance), cells_(frame.side) {}

    void search(unsigned level, const Cell& cell) {
        const Cell low = corner_of(level, cell);
        const int half = edge_of(level) / 2;
        const Vec3 centre = frame_.point({low[0] + half, low[1] + half, low[2] + half});
        const double edge = 2 * half * frame_.length / frame_.units;
        const double radius = distance_ + half_diagonal * edge;
        if (same_(centre, radius)) return;
        if (level == 0) return cells_.add(cell);
        for (int n = 0; n < 8; ++n)
            search(level - 1,
                   {2 * cell[0] + (n & 1), 2 * cell[1] + (n >> 1 & 1), 2 * cell[2] + (n >> 2)});
    }
    const CellSet& cells() const { return cells_; }

private:
    const Frame& frame_;
    const SameWithin& same_;
    double distance_;
    CellSet cells_;
};

}  // namespace

Octree::Octree(const Frame& frame, unsigned top, const SameWithin& same, unsigned layers,
               unsigned coarse_layers) {
    divided_.emplace_back(frame.side);
    if (top == 0) return;
    // The surface itself crosses one layer.
    const double distance = (layers - 1) * 2 * frame.length / frame.units;
    Near near(frame, same, distance);
    const auto roots = static_cast<int>(frame.side >> top);
    for (int k = 0; k < roots; ++k) {
        for (int j = 0; j < roots; ++j) {
            for (int i = 0; i < roots; ++i) near.search(top, {i, j, k});
        }
    }
    divided_.push_back(near.cells().parents());
    while (divided_.size() <= top)
        divided_.push_back(divided_.back().grown(coarse_layers).parents());
}

Octree::Octree(const Frame& frame, unsigned top) {
    for (unsigned level = 0; level <= top; ++level) divided_.emplace_back(frame.side >> level);
}

void Octree::surround(unsigned level, const Cell& cell) {
    if (level >= top()) return;
    const auto parents = static_cast<int>(side(level + 1));
    // Three cells in a row have two parents.
    for (int n = 0; n < 8; ++n) {
        const Cell parent = {(n & 1) != 0 ? (cell[0] + 1) >> 1 : (cell[0] - 1) >> 1,
                             (n & 2) != 0 ? (cell[1] + 1) >> 1 : (cell[1] - 1) >> 1,
                             (n & 4) != 0 ? (cell[2] + 1) >> 1 : (cell[2] - 1) >> 1};
        const auto within = [&](int x) { return x >= 0 && x < parents; };
        if (within(parent[0]) && within(parent[1]) && within(parent[2])) divide(level + 1, parent);
    }
}

void Octree::divide(unsigned level, const Cell& cell) {
    if (level == 0 || divided_[level].has(cell)) return;
    surround(level, cell);
    divided_[level].add(cell);
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

}  // namespace dsc::generate::lattice
