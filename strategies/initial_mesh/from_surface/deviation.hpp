#pragma once
// The distance between two surfaces.

#include <dsc/surface/triangle_mesh.hpp>

#include "solid.hpp"

namespace dsc::strategies::from_surface {

/// Greatest distances from points of one surface to the other. The points are the vertices and
/// points at most `spacing` apart along and inside the faces.
struct Deviation {
    double of_vertices = 0;        ///< from vertices of the interface to the surface
    double of_interface = 0;       ///< from any point of the interface to the surface
    double of_surface = 0;         ///< from any point of the surface to the interface
    Vec3 farthest = Vec3::Zero();  ///< the point with the greater of the last two distances

    double greatest() const { return std::max(of_interface, of_surface); }
};

/// `interface` must have faces. [setup]
Deviation deviation(const surface::TriangleMesh& interface, const Solid& solid, double spacing,
                    Workers* workers);

}  // namespace dsc::strategies::from_surface
