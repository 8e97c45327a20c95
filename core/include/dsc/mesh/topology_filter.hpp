#pragma once
// Labels of a tet mesh's vertices from values, without the handles that only weak values make.

#include <array>
#include <cstddef>
#include <cstdint>
#include <dsc/geometry/vec.hpp>
#include <optional>
#include <span>
#include <vector>

namespace dsc::mesh {

/// Components of the labels and of the interface that runs between them through the tets. A value above 0 is inside;
/// vertices of a label are connected along edges.
struct TopologyCounts {
    std::size_t components = 0;  ///< of the inside
    std::size_t cavities = 0;    ///< components of the outside that do not reach the box
    std::size_t shells = 0;      ///< components of the interface
    long euler = 0;              ///< of the interface
    bool closed = true;          ///< whether the interface ends nowhere on the box

    /// Sum over the shells of a closed interface. [parallel]
    long genus() const { return static_cast<long>(shells) - euler / 2; }
    bool operator==(const TopologyCounts&) const = default;
};

/// Counts without building the interface. The tets fill a box, conforming; one value per point. [step]
TopologyCounts count_topology(std::span<const Vec3> points,
                              std::span<const std::array<std::uint32_t, 4>> tets,
                              std::span<const double> values);

/// Vertices beside each other whose label was changed.
struct RefusedCluster {
    Vec3 place;        ///< mean of the vertices
    double level = 0;  ///< largest distance of their values from 0, before
    std::size_t vertices = 0;
    bool was_inside = false;  ///< a bridge was cut; else a tunnel was closed
};

/// A part with values from tau on that is connected to a larger one only through a vertex of a lower value.
struct Attachment {
    double level = 0;  ///< distance of that value from 0; a low one means that the connection may be wrong
    Vec3 place = Vec3::Zero();  ///< of the vertex
    std::size_t vertices = 0;   ///< of the smaller part, with values from tau on
    bool inside = true;         ///< else of the outside: the way into a hollow
};

/// What filter_topology() did.
struct TopologyFilterReport {
    TopologyCounts before, after;
    std::size_t refused = 0;                    ///< changes of a label, over both passes
    std::vector<RefusedCluster> clusters;       ///< bridges first, each kind by its lowest vertex
    std::vector<Attachment> attachments;        ///< of the inside first, in the order of growth
    std::optional<Attachment> inside, outside;  ///< those with the lowest level, of parts of any size
};

/// Homotopic growth of the certain inside, values from tau on, down to 0 and then of the certain outside up to 0. The
/// vertex with the strongest value comes first, of equal ones the first. It is refused while the grown part of its
/// link has more components than the whole has near it, as it would close a loop there; it is asked again when a
/// vertex beside it has been added. Vertices refused to the end get the other sign and 1e-3, or tau / 2 if that is
/// less. Parts that start below tau or are merged by a vertex are allowed. One value per point; tau > 0 in units of
/// the values; the tets fill a box, conforming. O(T + U log U) for T tets and U values below tau. [step]
TopologyFilterReport filter_topology(std::span<const Vec3> points,
                                     std::span<const std::array<std::uint32_t, 4>> tets,
                                     std::span<double> values, double tau = 0.2);

/// The attachment with the lowest level, of the inside or the outside, of parts with at least so many vertices; the first
/// of equal ones. None where all such parts stay apart or are connected by values from tau on. [parallel]
std::optional<Attachment> weakest_attachment(const TopologyFilterReport& report, bool inside,
                                             std::size_t least_vertices);

}  // namespace dsc::mesh
