#pragma once
// Labels the vertices of a tet mesh by their values, without the handles that only weak values
// cause.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::generate {

/// Components of the labels, and of the interface between them through the tets. A value above 0 is
/// inside; vertices of a label are connected along edges.
struct TopologyCounts {
    std::size_t components = 0;  ///< of the inside
    std::size_t cavities = 0;    ///< components of the outside that do not reach the box
    std::size_t shells = 0;      ///< components of the interface
    long euler = 0;              ///< of the interface
    bool closed = true;          ///< whether the interface has no border on the box

    /// Genus, summed over the shells of a closed interface. [parallel]
    long genus() const { return static_cast<long>(shells) - euler / 2; }
    bool operator==(const TopologyCounts&) const = default;
};

/// Counts without building the interface. The tets must fill a box and conform; one value per
/// point. [step]
TopologyCounts count_topology(std::span<const Vec3> points,
                              std::span<const std::array<std::uint32_t, 4>> tets,
                              std::span<const double> values);

/// Neighbouring vertices that growth refused, because they close a loop.
struct RefusedCluster {
    Vec3 place;        ///< mean of the vertices
    double level = 0;  ///< largest absolute value
    std::vector<std::uint32_t> vertices{};
    bool was_inside = false;  ///< true: a bridge; false: a tunnel
};

/// Decides by evidence other than the values whether a bridge or a tunnel is real, so that it keeps
/// its labels.
using LoopWitness = std::function<bool(const RefusedCluster&)>;

/// A part with values of at least tau that is connected to a larger part only through a vertex of a
/// lower value.
struct Attachment {
    double level = 0;  ///< absolute value at that vertex; a low level means that the connection may
                       ///< be wrong
    Vec3 place = Vec3::Zero();  ///< of the connecting vertex
    std::size_t vertices = 0;   ///< of the smaller part, with values of at least tau
    bool inside = true;         ///< false: of the outside, so the connection leads into a cavity
};

/// Report of filter_topology().
struct TopologyFilterReport {
    TopologyCounts before, after;
    std::size_t refused = 0;                ///< number of changed labels, over both passes
    std::vector<RefusedCluster> clusters;   ///< that changed; bridges first, each kind in the order
                                            ///< of its lowest vertices
    std::vector<RefusedCluster> confirmed;  ///< that the witness kept, in the same order
    std::vector<Attachment> attachments;    ///< of the inside first, in the order of growth
    std::optional<Attachment> inside, outside;  ///< those with the lowest level, for parts of any
                                                ///< size
};

/// Homotopic growth: first the certain inside (values of at least tau) grows down to 0, then the
/// certain outside grows up to 0. The vertex with the strongest value comes first; of equal ones
/// the first. A vertex is refused while the grown part of its link has more components than the
/// whole grown part has near it, because the vertex would close a loop. It is tested again after a
/// neighbour has been added. Vertices that stay refused get the other sign and the absolute value
/// 1e-3, or tau / 2 if that is less, unless `witness` keeps their cluster. Parts that start below
/// tau, and the joining of parts, are allowed. One value per point; tau > 0 in units of the values;
/// the tets must fill a box and conform. O(T + U log U) for T tets and U values below tau. [step]
TopologyFilterReport filter_topology(std::span<const Vec3> points,
                                     std::span<const std::array<std::uint32_t, 4>> tets,
                                     std::span<double> values, double tau = 0.2,
                                     const LoopWitness& witness = {});

/// The attachment with the lowest level, of the inside or the outside, of parts with at least that
/// many vertices; the first of equal ones. None if all such parts stay separate or are connected by
/// values of at least tau. [parallel]
std::optional<Attachment> weakest_attachment(const TopologyFilterReport& report, bool inside,
                                             std::size_t least_vertices);

}  // namespace dsc::generate
