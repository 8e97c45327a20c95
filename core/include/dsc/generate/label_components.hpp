#pragma once
// Islands and cavities of labelled vertices: finds them and decides which ones stay.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::generate {

/// What to do with enclosed components of the outside. Cavities below the least volume never stay.
enum class CavityPolicy {
    automatic,  ///< a cavity stays if it is certain and points of the cloud lie at its shell
    keep,
    fill
};

/// Decides which components stay. Lengths are in the mesh's units.
struct ComponentOptions {
    CavityPolicy cavities = CavityPolicy::automatic;
    bool remove_islands = true;  ///< remove components of the inside below the least volume; the
                                 ///< largest component always stays
    double width = 0;            ///< median local width of the cloud
    double least_volume = 30;    ///< in cubes of the width
    double certain = 0.2;        ///< an automatic cavity must have a value below minus this number
    std::size_t least_points = 12;  ///< least number of points nearest to the shell of an automatic
                                    ///< cavity
};

/// Points of a cloud and, for each of them, a vertex near it.
struct PlacedPoints {
    std::span<const Vec3> places;
    std::span<const std::uint32_t> vertices;
};

/// One component of the inside, or one cavity, before any change.
struct LabelComponent {
    bool inside = true;         ///< false: a cavity
    bool kept = true;           ///< false: it was given the other label
    double volume = 0;          ///< sum of the volumes of its vertices
    Vec3 place = Vec3::Zero();  ///< mean of the vertices
    std::size_t vertices = 0;
    double peak = 0;         ///< largest absolute value
    std::size_t points = 0;  ///< nearest to its shell; counted only if CavityPolicy::automatic
                             ///< needs it
};

/// Gives the other label to islands and cavities that do not stay: their vertices get 1e-3 with the
/// other sign. Islands are removed first, so the rule for a cavity already takes their removal into
/// account.
///
/// A value above 0 is inside; vertices of a label are connected along edges; the tets fill a box.
/// One value and one volume per point (GradedLattice::volumes()). A point of the cloud belongs to
/// the shell that cuts the edges round its nearest vertex, by linear interpolation of the values
/// before; it belongs to no shell if no edge is cut. Returns all components of the inside and all
/// cavities, by their lowest vertices. A component inside a component that did not stay is listed
/// as it was before; it counts as kept if its label is the same afterwards. O(T). [step]
std::vector<LabelComponent> settle_components(std::span<const Vec3> points,
                                              std::span<const std::array<std::uint32_t, 4>> tets,
                                              std::span<double> values,
                                              std::span<const double> volumes,
                                              const PlacedPoints& cloud,
                                              const ComponentOptions& options);

}  // namespace dsc::generate
