#pragma once
// A box of tets with a wanted size per place. It can be refined further where its values require
// it.

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <dsc/base/progress.hpp>
#include <dsc/base/workers.hpp>
#include <dsc/generate/lattice.hpp>
#include <dsc/geometry/vec.hpp>

namespace dsc::generate {

/// A wanted size, in the mesh's units: the cell that contains the place, and the 26 places around
/// that cell at its size, get cells of at most this edge.
struct CellSize {
    Vec3 place;
    double cell;
};

/// The largest number of finest cells along the box of a graded lattice.
inline constexpr int most_graded_cells = 4096;

/// A balanced octree like that of make_lattice(), in which cells that share a corner differ by at
/// most a factor of two.
///
/// Vertices are the corners and centres of its cells, and the centres of the cells' faces on the
/// box. They keep their numbers: dividing cells only adds vertices. So plain arrays can store
/// values per vertex.
class GradedLattice {
public:
    /// A cell that is not divided.
    struct Leaf {
        std::array<std::uint32_t, 9> vertices;  ///< eight corners, x running fastest, then the
                                                ///< centre
        double edge;
    };

    /// Uses `cells` or `cell`, `box` and `box_centre` of the options. They give the size of the
    /// smallest possible cells, and the box; the box grows by less than one of its largest cells if
    /// necessary. At least six of the largest cells fit along the box. Sizes below the smallest
    /// size count as the smallest size. The order of the sizes has no influence. Messages use
    /// `name` for the generator. Throws ConfigError "lattice.size" for less than
    /// least_lattice_cells or more than most_graded_cells along the box, or for a lattice that
    /// would be too large. [setup]
    GradedLattice(const LatticeOptions& options, std::span<const CellSize> sizes,
                  std::string_view name);
    ~GradedLattice();
    GradedLattice(GradedLattice&&) noexcept;
    GradedLattice& operator=(GradedLattice&&) noexcept;

    /// Positions of the vertices by number; valid until cells are divided. [parallel]
    std::span<const Vec3> points() const;
    /// In Morton order; valid until cells are divided. [parallel]
    std::span<const Leaf> leaves() const;
    /// The whole box, and the edge of the smallest possible cells. [parallel]
    Box3 box() const;
    double finest_cell() const;

    /// Divides the leaves with these indices, and other leaves where balance requires it; leaves of
    /// the smallest size stay unchanged. Returns the number of vertices before: vertices from this
    /// number on are new. Throws ConfigError "lattice.size". [setup]
    std::size_t split(std::span<const std::uint32_t> leaves);
    /// The same for all leaves that the function chooses; it is called for every leaf in order.
    /// [setup]
    std::size_t split_where(const std::function<bool(const Leaf&)>& chosen);

    /// The coarsest such lattice in which every leaf with both labels is still a leaf. Merged
    /// leaves have one label, so the labels keep their topology. `values`: one per vertex, above 0
    /// inside. The vertices of the result are some of the vertices of this lattice in another
    /// order; `origins` receives their numbers in this lattice. [setup]
    GradedLattice coarsened(std::span<const double> values,
                            std::vector<std::uint32_t>& origins) const;

    /// Tets that fill the box, all positive and conforming, with the lattice's vertex numbers;
    /// every vertex is used. They are those of LatticePattern::bcc. `workers`, null for one thread,
    /// share the work. Throws CancelledError. [setup]
    std::vector<std::array<std::uint32_t, 4>> tets(Workers* workers = nullptr,
                                                   const CancelToken* cancel = nullptr) const;
    /// The volume that belongs to each vertex: half of its cell for a centre, a sixteenth of each
    /// adjacent cell for a corner. The sum is the volume of the box. [parallel]
    std::vector<double> volumes() const;
    /// The nearest of the nine vertices of the leaf that contains the place; the first of equally
    /// near ones. A place outside the box counts as the nearest place inside. [parallel]
    std::uint32_t vertex_near(const Vec3& place) const;

private:
    struct Parts;
    explicit GradedLattice(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

/// Whether the leaf has vertices of both labels: values above 0 are inside. [parallel]
bool has_mixed_signs(const GradedLattice::Leaf& leaf, std::span<const double> values);

}  // namespace dsc::generate
