// The winding number of a closed surface, by exact ray crossings.
#include "dsc/surface/winding.hpp"

#include <dsc/geometry/predicates.hpp>
#include <dsc/surface/measure.hpp>

#include "surface/box_tree.hpp"

namespace dsc::surface {
namespace {

using Triangle = std::array<Vec3, 3>;
constexpr int y_axis = 1, z_axis = 2;

std::vector<Triangle> triangles_of(const TriangleMesh& mesh) {
    require_sound(mesh);
    std::vector<Triangle> out;
    out.reserve(mesh.faces.size());
    for (const auto& [a, b, c] : mesh.faces)
        out.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
    return out;
}

std::vector<Box3> boxes_of(const std::vector<Triangle>& triangles) {
    std::vector<Box3> boxes;
    boxes.reserve(triangles.size());
    for (const Triangle& t : triangles) boxes.push_back(bounding_box(t));
    return boxes;
}

// Winding of the triangle round p, seen along x: -1, 0 or 1. Sides count if they pass p on the side
// of smaller y. If p has the same height as a corner, it counts as slightly higher; if p lies on a
// side, it counts as beyond it, towards larger y: as if moved by (0, e, e^2) for an infinitely
// small e. So a side that two triangles share counts for both or for none.
int winding_in_yz(const Triangle& t, const Vec3& p) {
    int winding = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = t[i], &b = t[(i + 1) % 3];
        const bool up = a.z() <= p.z() && b.z() > p.z();
        const bool down = b.z() <= p.z() && a.z() > p.z();
        if (!up && !down) continue;
        const int side = geometry::orient2d(a, b, p, y_axis, z_axis);
        // Left of an upward side means smaller y.
        if (up && side > 0) ++winding;
        if (down && side < 0) --winding;
    }
    return winding;
}

// For the ray from p along +x. A triangle that contains p is behind p, as if p were moved more
// along x than along y.
int crossing(const Triangle& t, const Vec3& p) {
    const int winding = winding_in_yz(t, p);
    if (winding == 0) return 0;
    // Seen along x, a triangle with winding 1 has its normal towards +x; p is before its plane if
    // it is below the plane.
    const int side = geometry::orient3d(t[0], t[1], t[2], p);
    return side * winding < 0 ? winding : 0;
}

}  // namespace

struct WindingNumber::Data {
    std::vector<Triangle> triangles;
    BoxTree tree;
    explicit Data(const TriangleMesh& mesh)
        : triangles(triangles_of(mesh)), tree(boxes_of(triangles)) {}
};

WindingNumber::WindingNumber(const TriangleMesh& mesh) : data_(std::make_unique<Data>(mesh)) {}
WindingNumber::~WindingNumber() = default;
WindingNumber::WindingNumber(WindingNumber&&) noexcept = default;
WindingNumber& WindingNumber::operator=(WindingNumber&&) noexcept = default;

int WindingNumber::at(const Vec3& p) const {
    int winding = 0;
    const auto on_ray = [&](const Box3& box) {
        return p.x() <= box.high.x() && box.low.y() <= p.y() && p.y() <= box.high.y() &&
               box.low.z() <= p.z() && p.z() <= box.high.z();
    };
    data_->tree.visit(on_ray,
                      [&](std::uint32_t i) { winding += crossing(data_->triangles[i], p); });
    return winding;
}

}  // namespace dsc::surface
