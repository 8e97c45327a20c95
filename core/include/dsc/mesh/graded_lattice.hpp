#pragma once
// A box of tets whose sizes are asked for place by place and which is refined further where its values say so.

#include <array>
#include <cstdint>
#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/lattice.hpp>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace dsc::mesh {

/// A wanted size, in the mesh's units: the cell that contains the place and the 26 places beside that cell, at its
/// size, get cells of at most this edge.
struct CellSize {
    Vec3 place;
    double cell;
};

/// Most finest cells along the box of a graded lattice.
inline constexpr int most_graded_cells = 4096;

/// A balanced octree like that of make_lattice(), in which cells that share a corner differ by at most a factor of two.
///
/// Vertices are the corners and centres of its cells, and the centres of the cells' faces on the box. They keep their
/// numbers: where cells are divided, vertices are only added. So values of the vertices can be kept in plain arrays.
class GradedLattice {
public:
    /// A cell that is not divided.
    struct Leaf {
        std::array<std::uint32_t, 9> vertices;  ///< eight corners, x running fastest, then the centre
        double edge;
    };

    /// Of the options count `cells` or `cell`, `box` and `box_centre`: they give the smallest cells that there can
    /// be, and the box, which grows by less than one of its largest cells where it must; those go at least six times
    /// into it. Sizes below that of the smallest cells ask for the smallest cells; the order of the sizes has no
    /// influence. `name` is the generator named in messages. Throws ConfigError "lattice.size" for less than
    /// least_lattice_cells or more than most_graded_cells along the box, or for a lattice that would be too large.
    /// [setup]
    GradedLattice(const LatticeOptions& options, std::span<const CellSize> sizes, std::string_view name);
    ~GradedLattice();
    GradedLattice(GradedLattice&&) noexcept;
    GradedLattice& operator=(GradedLattice&&) noexcept;

    /// Positions of the vertices by their numbers; valid until cells are divided. [parallel]
    std::span<const Vec3> points() const;
    /// In Morton order; valid until cells are divided. [parallel]
    std::span<const Leaf> leaves() const;
    /// The whole box, and the edge of the smallest cells that there can be. [parallel]
    Box3 box() const;
    double finest_cell() const;

    /// Divides the leaves of these indices, and others so far as balance needs it; leaves of the smallest size stay
    /// as they are. Returns the number of vertices before: those from it on are new. Throws ConfigError
    /// "lattice.size". [setup]
    std::size_t split(std::span<const std::uint32_t> leaves);
    /// The same for all leaves that the function chooses; it is asked for every one in order. [setup]
    std::size_t split_where(const std::function<bool(const Leaf&)>& chosen);

    /// The coarsest such lattice in which every leaf with both labels is a leaf as it is here. What is merged has one label,
    /// so the labels have the same topology. One value per vertex, above 0 inside. Its vertices are some of those here, in
    /// another order: `origins` gets their numbers here. [setup]
    GradedLattice coarsened(std::span<const double> values, std::vector<std::uint32_t>& origins) const;

    /// Tets that fill the box, all positive and conforming, with the lattice's numbers; every vertex is used. They
    /// are those of LatticePattern::bcc. `workers`, null for one thread, share the work. Throws CancelledError. [setup]
    std::vector<std::array<std::uint32_t, 4>> tets(Workers* workers = nullptr, const CancelToken* cancel = nullptr) const;
    /// The volume that belongs to each vertex: half of its cell for a centre, a sixteenth of each of its cells for a corner. The sum
    /// is the volume of the box. [parallel]
    std::vector<double> volumes() const;
    /// The nearest of the nine vertices of the leaf that contains the place, the first one of equally near ones. Places
    /// outside the box count as the nearest ones in it. [parallel]
    std::uint32_t vertex_near(const Vec3& place) const;

private:
    struct Parts;
    explicit GradedLattice(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

/// Whether the leaf has vertices of both labels: values above 0 are inside. [parallel]
bool has_mixed_signs(const GradedLattice::Leaf& leaf, std::span<const double> values);

}  // namespace dsc::mesh
