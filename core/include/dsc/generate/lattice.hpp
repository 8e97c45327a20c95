#pragma once
// A box of tets that are small where this is wanted and become larger with the distance.

#include <functional>
#include <optional>
#include <string_view>

#include <dsc/base/progress.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/tet_mesh.hpp>

namespace dsc::generate {

/// Tets of the finest cells: parity cuts each cell into five tets; bcc uses the tets of all larger
/// cells.
enum class LatticePattern { parity, bcc };

/// Sizes of a lattice, in the mesh's units.
struct LatticeOptions {
    int cells = 30;                ///< number of finest cells along the box
    std::optional<double> cell{};  ///< edge of the finest cells, instead of `cells`
    double box = 1.5;              ///< half the edge of the box; the box may become larger
    Vec3 box_centre = Vec3::Zero();
    int layers = 2;       ///< layers of finest cells on each side of the refined places, at least 2
    double growth = 2.0;  ///< average growth of the cells from layer to layer, 1 to 2
    LatticePattern finest = LatticePattern::parity;

    /// Number of finest cells along the box, before it is rounded up to a number that the octree
    /// allows.
    double wanted_cells() const;
};

/// Range of LatticeOptions::wanted_cells().
inline constexpr int least_lattice_cells = 4, most_lattice_cells = 1024;

/// Edge of the finest cells. [parallel]
double finest_cell(const LatticeOptions& options);
/// The box as it will be made: at least the wanted size; the size of the finest cells is kept.
/// [parallel]
Box3 box_of(const LatticeOptions& options);

/// Whether all tets in the ball of this centre and radius certainly have the same label.
using SameWithin = std::function<bool(const Vec3& centre, double radius)>;

/// Makes a balanced octree and fills its cells with tets of a few well-shaped kinds
/// [LabelleShewchuk2007], all positive, with label 0. Cells where `same` is false, and `layers`
/// around them, have the finest size. Messages use `name` for the generator. Throws CancelledError,
/// ConfigError "lattice.size" for a mesh that would be too large. [setup]
mesh::TetMesh make_lattice(const LatticeOptions& options, const SameWithin& same,
                           std::string_view name, const CancelToken* cancel = nullptr);

/// Whether a tet of a label above 0 has a vertex on the faces of the mesh's box. [parallel]
bool labels_touch_box(const mesh::TetMesh& mesh);

}  // namespace dsc::generate
