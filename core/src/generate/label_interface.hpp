#pragma once
// Counts of the surface between two labels of vertices; it has one polygon per tet with both
// labels.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::generate {

/// Counts the cut edges, cut faces and cut tets, which are the vertices, edges and faces of the
/// interface. All tets with both labels must be added.
class InterfaceCounter {
public:
    InterfaceCounter(std::span<const Vec3> points, const Box3& box)
        : points_(points), box_(box), slots_(1024, 0) {}

    void add(const std::array<std::uint32_t, 4>& tet, const std::array<bool, 4>& inside);

    long euler() const;
    /// Whether no cut face lies on the box.
    bool closed() const { return box_faces_ == 0; }

private:
    void add_edge(std::uint32_t a, std::uint32_t b);
    bool on_one_side(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

    std::span<const Vec3> points_;
    Box3 box_;
    std::vector<std::uint64_t> slots_;  // cut edges by their ends; 0 is unused, because the ends of
                                        // an edge differ
    std::size_t edges_ = 0, tets_ = 0, faces_of_tets_ = 0, box_faces_ = 0;
};

}  // namespace dsc::generate
