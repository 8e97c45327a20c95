#pragma once
// Decides which cells of the octree are divided: all cells where labels may differ or where small
// cells are wanted; fewer with the distance from there.

#include <vector>

#include <dsc/generate/lattice.hpp>
#include <dsc/geometry/vec.hpp>

#include "generate/cell_set.hpp"

namespace dsc::generate::lattice {

/// The position of the octree's integer coordinates in space: from 0 to 2 side along each axis, in
/// halves of a finest cell, so that centres of cells have coordinates too.
struct Frame {
    unsigned side = 0;  ///< finest cells along the box, even
    double length = 0;  ///< of `units` halves of a finest cell
    double units = 1;
    Vec3 centre = Vec3::Zero();  ///< of the box

    /// Coordinate relative to the centre. Exactly symmetric: coordinate x is minus coordinate 2
    /// side - x.
    double at(int x) const {
        return length * static_cast<double>(x - static_cast<int>(side)) / units;
    }
    Vec3 point(const Cell& x) const { return centre + Vec3(at(x[0]), at(x[1]), at(x[2])); }
    /// Edge of a finest cell.
    double cell() const { return 2 * length / units; }
};

/// Level 0 has the finest cells; a cell of level l + 1 consists of eight cells of level l. Cells
/// that share an edge or a part of an edge differ by at most one level.
class Octree {
public:
    /// Level 0: all cells closer than `layers` - 1 of their edges to places where labels differ.
    /// Then follow at least `coarse_layers` of each further level up to `top`. The side must be a
    /// multiple of 2^top.
    Octree(const Frame& frame, unsigned top, const SameWithin& same, unsigned layers,
           unsigned coarse_layers);

    /// Only cells of the top level; to be used with divide().
    Octree(const Frame& frame, unsigned top);

    /// Divides cells until there are cells of this level or finer at this cell and at its 26
    /// neighbours.
    void surround(unsigned level, const Cell& cell);
    /// Divides a cell, after larger cells at its place or next to it. If cells that share a corner
    /// differed by at most one level before, they still do afterwards. Cells of level 0 are not
    /// divided.
    void divide(unsigned level, const Cell& cell);

    unsigned top() const { return static_cast<unsigned>(divided_.size()) - 1; }
    unsigned side(unsigned level) const { return divided_[level].side(); }
    /// Whether there are cells of the next finer level in this cell's place. False outside the box
    /// and at level 0.
    bool divided(unsigned level, const Cell& cell) const {
        return level > 0 && divided_[level].has(cell);
    }
    /// Whether a cell of this level belongs to the mesh: it is neither divided nor part of a larger
    /// cell.
    bool leaf(unsigned level, const Cell& cell) const;
    /// Number of cells of the mesh.
    std::size_t leaves() const;

private:
    std::vector<CellSet> divided_;
};

/// Low corner of a cell in the frame's coordinates, and its edge.
inline Cell corner_of(unsigned level, const Cell& c) {
    return {c[0] << (level + 1), c[1] << (level + 1), c[2] << (level + 1)};
}
inline int edge_of(unsigned level) { return 2 << level; }

}  // namespace dsc::generate::lattice
