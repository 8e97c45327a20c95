#pragma once
// How far two surfaces are apart.

#include <dsc/surface/triangle_mesh.hpp>

#include "solid.hpp"

namespace dsc::strategies::from_surface {

/// Greatest distances from points of one surface to the other, taken at every vertex and at most `spacing` apart along and
/// inside the faces.
struct Deviation {
    double of_vertices = 0;   ///< vertices of the interface from the surface
    double of_interface = 0;  ///< any point of the interface from the surface
    double of_surface = 0;    ///< any point of the surface from the interface
    Vec3 farthest = Vec3::Zero();  ///< where the greatest of the last two is

    double greatest() const { return std::max(of_interface, of_surface); }
};

/// `interface` must have faces. [setup]
Deviation deviation(const surface::TriangleMesh& interface, const Solid& solid, double spacing, Workers* workers);

}  // namespace dsc::strategies::from_surface
