#pragma once
// The hinges and neighbours of a view, over which the rows and sums of the fit run.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <dsc/surface/surface_view.hpp>

namespace dsc::strategies::fit {

/// An edge with two faces. The first contains the edge in the direction 0 -> 1 and the corner 2,
/// the second 1 -> 0 and 3.
struct Hinge {
    std::array<std::uint32_t, 4> vertices;
    std::array<std::uint32_t, 2> faces;
};

struct SurfaceLinks {
    std::vector<Hinge> hinges;  ///< of edges with two faces that are oriented alike, in the order
                                ///< of the edges
    std::vector<std::uint32_t> offsets;  ///< neighbours of vertex v: neighbours[offsets[v] ..
                                         ///< offsets[v + 1])
    std::vector<std::uint32_t> neighbours;

    std::span<const std::uint32_t> neighbours_of(std::size_t vertex) const {
        return std::span(neighbours)
            .subspan(offsets[vertex], offsets[vertex + 1] - offsets[vertex]);
    }
};

/// Fills `links` and reuses its memory. [step]
void build_links(const surface::SurfaceView& view, SurfaceLinks& links);

/// The sine of half the angle between two unit normals of a hinge, above 0 where the solid is
/// convex. `edge` leads from vertex 0 to vertex 1. [parallel]
double half_sine(const Vec3& first_normal, const Vec3& second_normal, const Vec3& edge);

}  // namespace dsc::strategies::fit
