// Measures the thickness of the solid with rays.
#include "dsc/surface/thickness.hpp"

#include <limits>

#include "surface/box_tree.hpp"

namespace dsc::surface {
namespace {

constexpr std::size_t ray_block = 256;  // vertices
constexpr double rounding = 1e-9;  // a ray through an edge must not pass between the two faces of
                                   // the edge
constexpr double never = std::numeric_limits<double>::infinity();

struct Ray {
    Vec3 from, along;

    /// Whether the ray is inside the box somewhere up to `most`.
    bool meets(const Box3& box, double most) const {
        double first = 0.0, last = most;
        for (int k = 0; k < 3; ++k) {
            if (along[k] == 0.0) {
                if (from[k] < box.low[k] || from[k] > box.high[k]) return false;
                continue;
            }
            const double a = (box.low[k] - from[k]) / along[k],
                         b = (box.high[k] - from[k]) / along[k];
            first = std::max(first, std::min(a, b));
            last = std::min(last, std::max(a, b));
        }
        return first <= last + rounding * most;
    }

    /// Distance to the triangle; infinity if the ray misses it [Moller1997].
    double distance(const Vec3& a, const Vec3& b, const Vec3& c) const {
        const Vec3 ab = b - a, ac = c - a, across = along.cross(ac);
        const double determinant = ab.dot(across);
        if (determinant == 0.0) return never;
        const Vec3 offset = from - a, turned = offset.cross(ab);
        const double u = offset.dot(across) / determinant, v = along.dot(turned) / determinant;
        if (!(u >= -rounding) || !(v >= -rounding) || !(u + v <= 1.0 + rounding)) return never;
        const double t = ac.dot(turned) / determinant;
        return t > 0.0 ? t : never;
    }
};

std::vector<Box3> face_boxes(const SurfaceView& view) {
    std::vector<Box3> boxes(view.face_count());
    for (std::size_t f = 0; f < boxes.size(); ++f) {
        for (const std::uint32_t v : view.faces[f]) boxes[f].extend(view.positions[v]);
    }
    return boxes;
}

double thickness_at(const SurfaceView& view, const BoxTree& tree, std::uint32_t v, double most,
                    double opposite) {
    if (view.normals[v].isZero(0.0)) return never;
    const Ray ray{view.positions[v], -view.normals[v]};
    double nearest = most;
    std::uint32_t hit = mesh::none;
    tree.visit([&](const Box3& box) { return ray.meets(box, nearest); },
               [&](std::uint32_t f) {
                   const auto& [a, b, c] = view.faces[f];
                   if (a == v || b == v || c == v) return;
                   const double d =
                       ray.distance(view.positions[a], view.positions[b], view.positions[c]);
                   if (!(d < nearest)) return;
                   nearest = d;
                   hit = f;
               });
    return hit != mesh::none && view.face_normals[hit].dot(ray.along) >= opposite ? nearest : never;
}

}  // namespace

void measure_thickness(const SurfaceView& view, double most, double opposite,
                       std::vector<double>& out, Workers* workers) {
    out.assign(view.vertex_count(), never);
    if (view.face_count() == 0) return;
    const BoxTree tree(face_boxes(view));
    for_blocks(workers, out.size(), ray_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            out[v] = thickness_at(view, tree, static_cast<std::uint32_t>(v), most, opposite);
    });
}

}  // namespace dsc::surface
