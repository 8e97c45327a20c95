#pragma once
// The interface with its edges, from which all edits of one pass are chosen.

#include <cstdint>
#include <span>
#include <vector>

#include <dsc/surface/surface_view.hpp>

namespace dsc::remesh {

/// Angle between the normals of the two faces of an edge, in radians, above which the edge is a
/// crease.
inline constexpr double crease_angle = 0.6;

/// One length per vertex, or one length for all vertices.
struct Lengths {
    double everywhere = 0.0;
    std::span<const double> each = {};  ///< empty, or one per view vertex

    double at(std::uint32_t v) const { return each.empty() ? everywhere : each[v]; }
    double along(std::uint32_t a, std::uint32_t b) const { return 0.5 * (at(a) + at(b)); }
};

/// A view with its edges. `view` must outlive it.
struct EdgeMesh {
    const surface::SurfaceView* view = nullptr;
    std::vector<surface::ViewEdge> edges;  ///< in ascending order of their vertices
    std::vector<double> lengths;           ///< of each edge
    std::vector<double> cosines;  ///< between the normals of the edge's two faces; 2 if it does not
                                  ///< have exactly two
    std::vector<std::uint8_t> creases;  ///< per vertex: number of its edges above crease_angle
    std::vector<std::uint8_t> fixed;  ///< per vertex: whether it may not move and takes part in no
                                      ///< collapse or flip

    /// Fills it from a view and reuses its memory. [step]
    void build(const surface::SurfaceView& from, Workers* workers = nullptr);
    const Vec3& place(std::uint32_t v) const { return view->positions[v]; }
    /// Whether the edge has two faces at an angle above crease_angle.
    bool is_crease(std::size_t edge) const;
    /// The corner of the edge's face `side`, 0 or 1, that is not on the edge.
    std::uint32_t opposite(std::size_t edge, unsigned side) const;
};

}  // namespace dsc::remesh
