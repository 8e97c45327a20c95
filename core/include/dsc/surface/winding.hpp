#pragma once
// Inside or outside of a closed surface, decided exactly.

#include <dsc/surface/triangle_mesh.hpp>
#include <memory>

namespace dsc::surface {

/// How often a closed, oriented surface winds round points: 1 inside a solid, 0 outside, 0 in a cavity whose faces look
/// into it, 2 where two bodies overlap, -1 inside a solid turned inside out. Keeps a copy of the triangles.
class WindingNumber {
public:
    /// Every edge must be used as often in one direction as in the other: otherwise the number has no meaning. Throws as
    /// require_sound(). [setup]
    explicit WindingNumber(const TriangleMesh& mesh);
    ~WindingNumber();
    WindingNumber(WindingNumber&&) noexcept;
    WindingNumber& operator=(WindingNumber&&) noexcept;

    /// Signed crossings of the ray from `p` along +x. Exact for all finite doubles: a ray through an edge or a vertex is
    /// pushed aside by an infinitely small amount, the same for all triangles; so a point exactly on the surface belongs
    /// to the side that lies towards +x, or, where that is the surface, +y, then +z. [parallel]
    int at(const Vec3& p) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace dsc::surface
