#pragma once
// A box of tets that are small where they are asked to be and grow away from there.

#include <dsc/base/progress.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/tet_mesh.hpp>
#include <functional>
#include <optional>
#include <string_view>

namespace dsc::mesh {

/// Tets of the finest cells: five of each cell by itself, or those of all larger cells.
enum class LatticePattern { parity, bcc };

/// Sizes of a lattice, in the mesh's units.
struct LatticeOptions {
    int cells = 30;              ///< finest cells along the box
    std::optional<double> cell;  ///< edge of the finest cells, instead of `cells`
    double box = 1.5;            ///< half the edge of the box, at least
    Vec3 box_centre = Vec3::Zero();
    int layers = 2;       ///< of finest cells on each side of what is refined, from 2
    double growth = 2.0;  ///< of the cells from layer to layer on average, 1 to 2
    LatticePattern finest = LatticePattern::parity;

    /// Finest cells along the box before they are rounded up to a number that the octree can have.
    double wanted_cells() const;
};

/// Range of LatticeOptions::wanted_cells().
inline constexpr int least_lattice_cells = 4, most_lattice_cells = 1024;

/// Edge of the finest cells. [parallel]
double finest_cell(const LatticeOptions& options);
/// The box as it will be made: at least as large as wanted, the size of the finest cells is kept. [parallel]
Box3 box_of(const LatticeOptions& options);

/// Whether all tets in the ball of this centre and radius will certainly have the same label.
using SameWithin = std::function<bool(const Vec3& centre, double radius)>;

/// A balanced octree, its cells filled with tets of a few well-shaped kinds [LabelleShewchuk2007], all positive, with
/// label 0; cells where `same` is false, and `layers` round them, are of the finest size. `name` is the generator named in
/// messages. Throws CancelledError, ConfigError "lattice.size" for a mesh that would be too large. [setup]
TetMesh make_lattice(const LatticeOptions& options, const SameWithin& same, std::string_view name,
                     const CancelToken* cancel = nullptr);

/// Whether a tet of a label above 0 has a vertex on the faces of the mesh's box. [parallel]
bool labels_touch_box(const TetMesh& mesh);

}  // namespace dsc::mesh
