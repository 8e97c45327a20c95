// A balanced octree with a wanted cell size per place, which can be divided further.
#include "dsc/generate/graded_lattice.hpp"

#include <algorithm>
#include <string>

#include <dsc/base/error.hpp>

#include "generate/lattice_frame.hpp"
#include "generate/lattice_octree.hpp"
#include "generate/lattice_tiling.hpp"
#include "generate/vertex_table.hpp"

namespace dsc::generate {
namespace {

using lattice::Cell;

// Level and position of a leaf's cell.
struct Place {
    unsigned level;
    Cell cell;

    bool operator==(const Place&) const = default;
};

// As make_lattice() reads the options: growth 1 would mean cells of one size.
LatticeOptions checked(LatticeOptions options, std::string_view name) {
    const double cells = options.wanted_cells();
    if (!(cells >= least_lattice_cells && cells <= most_graded_cells)) {
        throw ConfigError(
            "lattice.size", name,
            "the box contains " + std::to_string(cells) + " of the smallest cells in a row",
            "change the cells or the box so that there are " + std::to_string(least_lattice_cells) +
                " to " + std::to_string(most_graded_cells) + " of them");
    }
    options.growth = 2.0;
    return options;
}

}  // namespace

struct GradedLattice::Parts {
    Parts(const LatticeOptions& options, std::string_view caller)
        : name(caller),
          frame(lattice::frame_of(options)),
          octree(frame, lattice::top_level(options)) {}

    // The same box, only with cells of the top level.
    explicit Parts(const Parts& other, unsigned top)
        : name(other.name), frame(other.frame), octree(frame, top) {}

    // The smallest cell that contains the place or is nearest to it.
    Cell cell_at(const Vec3& place) const {
        Cell out{};
        for (int i = 0; i < 3; ++i) {
            const double x = (place[i] - frame.centre[i]) / frame.cell() + 0.5 * frame.side;
            // Also accepts a place that is NaN.
            out[static_cast<std::size_t>(i)] =
                !(x > 0) ? 0 : static_cast<int>(std::min(x, frame.side - 1.0));
        }
        return out;
    }
    static Cell at_level(unsigned level, const Cell& c) {
        return {c[0] >> level, c[1] >> level, c[2] >> level};
    }

    // Writes both lists of leaves from the octree. Earlier leaves keep their vertices.
    void list_leaves() {
        if (octree.leaves() > lattice::most_leaves) {
            throw lattice::too_large(name, octree.leaves(),
                                     "request larger cells, or small cells at fewer places");
        }
        std::vector<Leaf> old;
        std::vector<Place> old_places;
        old.swap(leaves);
        old_places.swap(places);
        leaves.reserve(octree.leaves());
        places.reserve(octree.leaves());
        std::size_t next = 0;
        const auto visit = [&](const auto& self, unsigned level, const Cell& cell) -> void {
            const bool was_leaf = next < old.size() && old_places[next] == Place{level, cell};
            if (octree.divided(level, cell)) {
                if (was_leaf) ++next;
                for (int n = 0; n < 8; ++n) {
                    self(self, level - 1,
                         {2 * cell[0] + (n & 1), 2 * cell[1] + (n >> 1 & 1),
                          2 * cell[2] + (n >> 2)});
                }
                return;
            }
            places.push_back({level, cell});
            leaves.push_back(was_leaf ? old[next++] : new_leaf(level, cell));
        };
        const auto roots = static_cast<int>(octree.side(octree.top()));
        for (int k = 0; k < roots; ++k) {
            for (int j = 0; j < roots; ++j) {
                for (int i = 0; i < roots; ++i) visit(visit, octree.top(), Cell{i, j, k});
            }
        }
        points.reserve(table.points().size());
        while (points.size() < table.points().size())
            points.push_back(frame.point(table.points()[points.size()]));
    }

    Leaf new_leaf(unsigned level, const Cell& cell) {
        Leaf leaf{};
        const Cell low = lattice::corner_of(level, cell);
        const int edge = lattice::edge_of(level), half = edge / 2;
        for (int n = 0; n < 8; ++n) {
            leaf.vertices[static_cast<std::size_t>(n)] = table.number(
                {low[0] + (n & 1) * edge, low[1] + (n >> 1 & 1) * edge, low[2] + (n >> 2) * edge});
        }
        const Cell centre = {low[0] + half, low[1] + half, low[2] + half};
        leaf.vertices[8] = table.number(centre);
        leaf.edge = frame.cell() * (1U << level);
        // The tets on the box meet at the centres of its faces.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Cell face = centre;
            if (cell[axis] == 0) {
                face[axis] -= half;
                table.number(face);
            } else if (cell[axis] + 1 == static_cast<int>(octree.side(level))) {
                face[axis] += half;
                table.number(face);
            }
        }
        return leaf;
    }

    std::string name;
    lattice::Frame frame;
    lattice::Octree octree;
    lattice::VertexTable table;
    std::vector<Vec3> points;
    std::vector<Leaf> leaves;
    std::vector<Place> places;
};

GradedLattice::GradedLattice(const LatticeOptions& options, std::span<const CellSize> sizes,
                             std::string_view name)
    : parts_(std::make_unique<Parts>(checked(options, name), name)) {
    Parts& p = *parts_;
    for (const CellSize& wanted : sizes) {
        unsigned level = 0;
        while (level < p.octree.top() && p.frame.cell() * (2U << level) <= wanted.cell) ++level;
        p.octree.surround(level, Parts::at_level(level, p.cell_at(wanted.place)));
    }
    p.list_leaves();
}
GradedLattice::GradedLattice(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
GradedLattice::~GradedLattice() = default;
GradedLattice::GradedLattice(GradedLattice&&) noexcept = default;
GradedLattice& GradedLattice::operator=(GradedLattice&&) noexcept = default;

std::span<const Vec3> GradedLattice::points() const { return parts_->points; }
std::span<const GradedLattice::Leaf> GradedLattice::leaves() const { return parts_->leaves; }
double GradedLattice::finest_cell() const { return parts_->frame.cell(); }

Box3 GradedLattice::box() const {
    const auto end = static_cast<int>(2 * parts_->frame.side);
    return {parts_->frame.point({0, 0, 0}), parts_->frame.point({end, end, end})};
}

std::size_t GradedLattice::split(std::span<const std::uint32_t> leaves) {
    const std::size_t before = parts_->points.size();
    for (const std::uint32_t i : leaves)
        parts_->octree.divide(parts_->places[i].level, parts_->places[i].cell);
    if (!leaves.empty()) parts_->list_leaves();
    return before;
}

std::size_t GradedLattice::split_where(const std::function<bool(const Leaf&)>& chosen) {
    std::vector<std::uint32_t> leaves;
    for (std::size_t i = 0; i < parts_->leaves.size(); ++i) {
        if (chosen(parts_->leaves[i])) leaves.push_back(static_cast<std::uint32_t>(i));
    }
    return split(leaves);
}

GradedLattice GradedLattice::coarsened(std::span<const double> values,
                                       std::vector<std::uint32_t>& origins) const {
    auto coarse = std::make_unique<Parts>(*parts_, parts_->octree.top());
    for (std::size_t i = 0; i < parts_->leaves.size(); ++i) {
        const auto& [level, cell] = parts_->places[i];
        if (level == coarse->octree.top() || !has_mixed_signs(parts_->leaves[i], values)) continue;
        coarse->octree.divide(level + 1, Parts::at_level(1, cell));
    }
    coarse->list_leaves();
    origins.clear();
    origins.reserve(coarse->points.size());
    for (const Cell& x : coarse->table.points()) origins.push_back(parts_->table.known(x));
    return GradedLattice(std::move(coarse));
}

std::vector<std::array<std::uint32_t, 4>> GradedLattice::tets(Workers* workers,
                                                              const CancelToken* cancel) const {
    return lattice::tile(parts_->octree, LatticePattern::bcc, parts_->table, workers, cancel);
}

std::vector<double> GradedLattice::volumes() const {
    std::vector<double> out(parts_->points.size(), 0.0);
    for (const Leaf& leaf : parts_->leaves) {
        const double volume = leaf.edge * leaf.edge * leaf.edge;
        for (std::size_t n = 0; n < 8; ++n) out[leaf.vertices[n]] += volume / 16;
        out[leaf.vertices[8]] += volume / 2;
    }
    return out;
}

std::uint32_t GradedLattice::vertex_near(const Vec3& place) const {
    const Parts& p = *parts_;
    const Cell finest = p.cell_at(place);
    unsigned level = p.octree.top();
    while (p.octree.divided(level, Parts::at_level(level, finest))) --level;
    const Cell cell = Parts::at_level(level, finest), low = lattice::corner_of(level, cell);
    const int edge = lattice::edge_of(level);
    Cell best{};
    double least = 0;
    for (int n = 0; n < 9; ++n) {
        const Cell x = n == 8 ? Cell{low[0] + edge / 2, low[1] + edge / 2, low[2] + edge / 2}
                              : Cell{low[0] + (n & 1) * edge, low[1] + (n >> 1 & 1) * edge,
                                     low[2] + (n >> 2) * edge};
        const double distance = (p.frame.point(x) - place).squaredNorm();
        if (n == 0 || distance < least) {
            least = distance;
            best = x;
        }
    }
    return p.table.known(best);
}

bool has_mixed_signs(const GradedLattice::Leaf& leaf, std::span<const double> values) {
    const bool inside = values[leaf.vertices[8]] > 0;
    return std::any_of(leaf.vertices.begin(), leaf.vertices.end(),
                       [&](std::uint32_t v) { return (values[v] > 0) != inside; });
}

}  // namespace dsc::generate
