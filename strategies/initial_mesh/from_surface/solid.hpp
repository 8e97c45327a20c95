#pragma once
// A closed surface as a solid: the points inside, and the distance to the surface.

#include <string>

#include <dsc/surface/distance.hpp>
#include <dsc/surface/triangle_mesh.hpp>
#include <dsc/surface/winding.hpp>

namespace dsc::strategies::from_surface {

/// The mesh with equal points joined, after a check that it bounds a solid: throws GeometryError
/// "surface.empty", "surface.open", "surface.not_manifold", "surface.misoriented",
/// "surface.self_intersecting" with `file`, the number of faults and the place of the first one. At
/// most `intersections` pairs of faces may intersect. [setup]
surface::TriangleMesh require_solid(const surface::TriangleMesh& mesh, const std::string& file,
                                    std::size_t intersections, Workers* workers);

/// The solid that a surface encloses: all points that it winds around, for any orientation of its
/// faces.
class Solid {
public:
    explicit Solid(surface::TriangleMesh mesh)
        : mesh_(std::move(mesh)), nearest_(mesh_), winding_(mesh_) {}

    const surface::TriangleMesh& surface() const { return mesh_; }
    surface::NearestHit nearest(const Vec3& p) const { return nearest_.nearest(p); }
    bool holds(const Vec3& p) const { return winding_.at(p) != 0; }

private:
    surface::TriangleMesh mesh_;
    surface::TriangleTree nearest_;
    surface::WindingNumber winding_;
};

}  // namespace dsc::strategies::from_surface
