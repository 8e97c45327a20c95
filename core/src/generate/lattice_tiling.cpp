// Fills the octree's cells with tets [LabelleShewchuk2007].
#include "generate/lattice_tiling.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <dsc/base/error.hpp>

#include "generate/vertex_table.hpp"

namespace dsc::generate::lattice {
namespace {

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

Cell moved(Cell x, std::size_t axis, int by) {
    x[axis] += by;
    return x;
}

// Table: VertexTable, or KnownNumbers.
template <class Table>
class Tiling {
public:
    Tiling(const Octree& octree, LatticePattern finest, Table& table,
           std::vector<std::array<std::uint32_t, 4>>& tets, const CancelToken* cancel)
        : octree_(octree), finest_(finest), table_(table), tets_(tets), cancel_(cancel) {}

    // The cells of the top level from `begin` to `end`, x running fastest.
    void fill(std::size_t begin, std::size_t end) {
        const unsigned top = octree_.top();
        const std::size_t roots = octree_.side(top);
        for (std::size_t n = begin; n < end; ++n) {
            if (cancel_ != nullptr && cancel_->cancelled())
                throw CancelledError("the run was stopped while it made its initial mesh");
            visit(top, {static_cast<int>(n % roots), static_cast<int>(n / roots % roots),
                        static_cast<int>(n / roots / roots)});
        }
    }

private:
    void visit(unsigned level, const Cell& cell) {
        if (octree_.divided(level, cell)) {
            for (int n = 0; n < 8; ++n) {
                visit(level - 1,
                      {2 * cell[0] + (n & 1), 2 * cell[1] + (n >> 1 & 1), 2 * cell[2] + (n >> 2)});
            }
        } else if (level == 0 && finest_ == LatticePattern::parity) {
            tile_by_parity(cell);
        } else {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                for (const int side : {-1, 1}) tile_face(level, cell, axis, side);
            }
        }
    }

    // One tet between the four corners with an even sum of coordinates, and one at each of the
    // other corners. The diagonals then run from the corners of a larger cell to the centre of its
    // face, where the tets on the other side have them, too.
    void tile_by_parity(const Cell& cell) {
        std::array<Cell, 4> even{}, odd{};
        std::size_t evens = 0, odds = 0;
        for (int n = 0; n < 8; ++n) {
            const Cell corner = {cell[0] + (n & 1), cell[1] + (n >> 1 & 1), cell[2] + (n >> 2)};
            const Cell x = {2 * corner[0], 2 * corner[1], 2 * corner[2]};
            if ((corner[0] + corner[1] + corner[2]) % 2 == 0) {
                even[evens++] = x;
            } else {
                odd[odds++] = x;
            }
        }
        add(even[0], even[1], even[2], even[3]);
        for (const Cell& x : odd) {
            // The three even corners that are neighbours of x: all except the one on the opposite
            // side of the cell.
            std::array<Cell, 3> near{};
            std::size_t nears = 0;
            for (const Cell& y : even) {
                if (x[0] == y[0] || x[1] == y[1] || x[2] == y[2]) near[nears++] = y;
            }
            add(x, near[0], near[1], near[2]);
        }
    }

    // A point and its number, which is requested at its first use, so that numbers follow the order
    // of the tets.
    struct Corner {
        Cell x;
        std::uint32_t number = no_number;
    };
    std::uint32_t number(Corner& corner) {
        if (corner.number == no_number) corner.number = table_.number(corner.x);
        return corner.number;
    }

    void tile_face(unsigned level, const Cell& cell, std::size_t axis, int side) {
        const Cell across = moved(cell, axis, side);
        const bool boundary =
            across[axis] < 0 || across[axis] >= static_cast<int>(octree_.side(level));
        const bool finer = octree_.divided(level, across);
        const bool equal = !boundary && !finer && octree_.leaf(level, across);
        if (equal && side < 0) return;  // the neighbour makes these tets
        const int half = edge_of(level) / 2;
        Cell centre = corner_of(level, cell);
        for (int& x : centre) x += half;
        const Cell middle = moved(centre, axis, side * half);
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        if (!boundary && !equal && !finer) {
            halve_pyramid(level, centre, middle, u, v, half);
            return;
        }
        const std::uint32_t from = table_.number(centre);
        const std::uint32_t apex = table_.number(equal ? moved(middle, axis, half) : middle);
        // Corners of the face, u running fastest.
        std::array<Corner, 4> corners{};
        for (std::size_t n = 0; n < 4; ++n) {
            corners[n].x = moved(moved(middle, u, (n & 1U) != 0 ? half : -half), v,
                                 (n & 2U) != 0 ? half : -half);
        }
        for (const bool along_u : {true, false}) {
            for (const int way : {-1, 1}) {
                const std::size_t first = way < 0 ? 0 : (along_u ? 2 : 1);
                Corner &a = corners[first], &b = corners[first + (along_u ? 1 : 2)];
                // Turns round the axis in the other direction for an edge along v.
                const bool positive = (side * way < 0) == along_u;
                const std::size_t out = along_u ? v : u;
                if (halved(level, cell, finer, axis, side, out, way)) {
                    Corner m{moved(middle, out, way * half)};
                    add(from, apex, a, m, positive);
                    add(from, apex, m, b, positive);
                } else {
                    add(from, apex, a, b, positive);
                }
            }
        }
    }

    // Whether a smaller cell has a corner in the middle of the edge between two faces of the cell.
    bool halved(unsigned level, const Cell& cell, bool finer, std::size_t axis, int side,
                std::size_t out, int way) const {
        if (level == 0) return false;
        return finer || octree_.divided(level, moved(cell, out, way)) ||
               octree_.divided(level, moved(moved(cell, axis, side), out, way));
    }

    // Cuts along the diagonal between the two corners with an even sum: a corner, and the centre of
    // the larger face.
    void halve_pyramid(unsigned level, const Cell& centre, const Cell& middle, std::size_t u,
                       std::size_t v, int half) {
        const auto corner = [&](int du, int dv) {
            return moved(moved(middle, u, du * half), v, dv * half);
        };
        const Cell low = corner(-1, -1);
        const int shift = static_cast<int>(level) + 1;
        if (((low[0] >> shift) + (low[1] >> shift) + (low[2] >> shift)) % 2 == 0) {
            add(centre, low, corner(1, 1), corner(1, -1));
            add(centre, low, corner(1, 1), corner(-1, 1));
        } else {
            add(centre, corner(1, -1), corner(-1, 1), low);
            add(centre, corner(1, -1), corner(-1, 1), corner(1, 1));
        }
    }

    void add(const Cell& a, const Cell& b, Cell c, Cell d) {
        using Wide = std::int64_t;
        const auto minus = [&](const Cell& x, std::size_t i) {
            return static_cast<Wide>(x[i] - a[i]);
        };
        Wide sign = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            sign += minus(b, i) * (minus(c, j) * minus(d, k) - minus(c, k) * minus(d, j));
        }
        if (sign < 0) std::swap(c, d);
        tets_.push_back({table_.number(a), table_.number(b), table_.number(c), table_.number(d)});
    }

    void add(std::uint32_t centre, std::uint32_t apex, Corner& c, Corner& d, bool positive) {
        Corner &third = positive ? c : d, &fourth = positive ? d : c;
        const std::uint32_t n = number(third);
        tets_.push_back({centre, apex, n, number(fourth)});
    }

    const Octree& octree_;
    LatticePattern finest_;
    Table& table_;
    std::vector<std::array<std::uint32_t, 4>>& tets_;
    const CancelToken* cancel_;
};

}  // namespace

std::vector<Corners> tile(const Octree& octree, LatticePattern finest, const VertexTable& table,
                          Workers* workers, const CancelToken* cancel) {
    const std::size_t roots = octree.side(octree.top());
    std::vector<std::vector<Corners>> parts(roots * roots * roots);
    for_blocks(workers, parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        KnownNumbers numbers(table);
        Tiling(octree, finest, numbers, parts[begin], cancel).fill(begin, end);
    });
    std::vector<std::size_t> starts(parts.size() + 1, 0);
    for (std::size_t i = 0; i < parts.size(); ++i) starts[i + 1] = starts[i] + parts[i].size();
    std::vector<Corners> tets(starts.back());
    for_blocks(workers, parts.size(), 1, [&](std::size_t begin, std::size_t) {
        std::copy(parts[begin].begin(), parts[begin].end(),
                  tets.begin() + static_cast<std::ptrdiff_t>(starts[begin]));
    });
    return tets;
}

mesh::TetMesh tile(const Octree& octree, const Frame& frame, LatticePattern finest,
                   const CancelToken* cancel) {
    mesh::TetMesh out;
    VertexTable table;
    const std::size_t roots = octree.side(octree.top());
    // Five to twelve tets per cell, more where sizes change.
    out.tets.reserve(10 * octree.leaves());
    Tiling(octree, finest, table, out.tets, cancel).fill(0, roots * roots * roots);
    out.points.reserve(table.points().size());
    for (const Cell& x : table.points()) out.points.push_back(frame.point(x));
    out.labels.assign(out.tets.size(), 0);
    return out;
}

}  // namespace dsc::generate::lattice
