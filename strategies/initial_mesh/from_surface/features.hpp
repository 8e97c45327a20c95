#pragma once
// Sharp edges and corners of a surface.

#include <optional>
#include <vector>

#include <dsc/surface/distance.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::strategies::from_surface {

/// Edges whose two faces differ by more than an angle, and corners: points where not exactly two
/// such edges meet, or two at an angle.
class Features {
public:
    /// `mesh` must be closed and manifold; the angle in radians. [setup]
    Features(const surface::TriangleMesh& mesh, double angle);

    const std::vector<Vec3>& corners() const { return corners_; }
    bool empty() const { return !edges_; }
    bool corner(const Vec3& p) const;
    /// The nearest point of the sharp edges; there must be at least one. [parallel]
    surface::NearestHit nearest(const Vec3& p) const { return edges_->nearest(p); }

private:
    std::vector<Vec3> corners_;
    std::optional<surface::TriangleTree> edges_;
};

}  // namespace dsc::strategies::from_surface
