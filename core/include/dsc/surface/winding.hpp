#pragma once
// Decides exactly whether a point is inside or outside a closed surface.

#include <memory>

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::surface {

/// Winding number of a closed, oriented surface round points: 1 inside a solid, 0 outside, 0 in a
/// cavity whose faces are oriented into it, 2 where two solids overlap, -1 inside a solid turned
/// inside out. Keeps a copy of the triangles.
class WindingNumber {
public:
    /// Every edge must be used equally often in both directions; otherwise the number has no
    /// meaning. Throws as require_sound(). [setup]
    explicit WindingNumber(const TriangleMesh& mesh);
    ~WindingNumber();
    WindingNumber(WindingNumber&&) noexcept;
    WindingNumber& operator=(WindingNumber&&) noexcept;

    /// Signed crossings of the ray from `p` along +x. Exact for all finite doubles: a ray through
    /// an edge or a vertex is shifted by an infinitely small amount, the same for all triangles. So
    /// a point exactly on the surface belongs to the side towards +x; if the surface lies in that
    /// direction, +y decides, then +z. [parallel]
    int at(const Vec3& p) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace dsc::surface
