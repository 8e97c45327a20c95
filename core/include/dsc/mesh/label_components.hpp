#pragma once
// Islands and cavities of labelled vertices: which there are, which stay.

#include <array>
#include <cstddef>
#include <cstdint>
#include <dsc/geometry/vec.hpp>
#include <span>
#include <vector>

namespace dsc::mesh {

/// What becomes of components of the outside that are enclosed. Those below the least volume never stay.
enum class CavityPolicy {
    automatic,  ///< those stay that are certain and that points of the cloud lie at
    keep,
    fill
};

/// Which components stay. Lengths in the mesh's units.
struct ComponentOptions {
    CavityPolicy cavities = CavityPolicy::automatic;
    bool remove_islands = true;  ///< of the inside, below the least volume; the largest one stays in any case
    double width = 0;            ///< local width of the cloud, its median
    double least_volume = 30;    ///< in cubes of the width
    double certain = 0.2;        ///< an automatic cavity has a value below the negative of this
    std::size_t least_points = 12;  ///< nearest to the shell of an automatic cavity
};

/// Points of a cloud and, for each of them, a vertex near it.
struct PlacedPoints {
    std::span<const Vec3> places;
    std::span<const std::uint32_t> vertices;
};

/// One component of the inside, or one cavity, as it was found.
struct LabelComponent {
    bool inside = true;  ///< else a cavity
    bool kept = true;    ///< else it was given the other label
    double volume = 0;   ///< sum of its vertices' shares
    Vec3 place = Vec3::Zero();  ///< mean of the vertices
    std::size_t vertices = 0;
    double peak = 0;         ///< largest distance of its values from 0
    std::size_t points = 0;  ///< nearest to its shell; counted only where CavityPolicy::automatic needs them
};

/// Gives the other label to islands and cavities that do not stay: their vertices get 1e-3 of the other sign. Islands
/// are removed first, so a cavity is judged with the room they leave.
///
/// A value above 0 is inside; vertices of a label are connected along edges; the tets fill a box. One value and one
/// volume per point (GradedLattice::volumes()). A point of the cloud belongs to the shell that cuts the edges of the
/// tets round its vertex nearest to it, by linear interpolation of the values before; to none where no edge is cut.
/// Returns all components of the inside and all cavities, by their lowest vertices. What was enclosed by a component
/// that did not stay is listed as it was found; it counts as kept where its label is the same. O(T). [step]
std::vector<LabelComponent> settle_components(std::span<const Vec3> points,
                                              std::span<const std::array<std::uint32_t, 4>> tets,
                                              std::span<double> values, std::span<const double> volumes,
                                              const PlacedPoints& cloud, const ComponentOptions& options);

}  // namespace dsc::mesh
