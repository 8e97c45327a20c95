// Nearest points of meshes and clouds.
#include "dsc/surface/distance.hpp"

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>
#include <dsc/surface/intersections.hpp>
#include <dsc/surface/measure.hpp>

#include "surface/box_tree.hpp"

namespace dsc::surface {
namespace {

Vec3 closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 ab = b - a;
    const double length = ab.squaredNorm();
    return length > 0.0 ? Vec3(a + std::clamp((p - a).dot(ab) / length, 0.0, 1.0) * ab) : a;
}

struct StoredTriangle {
    Vec3 a, b, c;
    bool degenerate;

    Box3 box() const {
        Box3 out;
        out.extend(a);
        out.extend(b);
        out.extend(c);
        return out;
    }
    /// A degenerate triangle is the union of its edges.
    Vec3 closest(const Vec3& p) const {
        if (!degenerate) return geometry::closest_point_on_triangle(p, a, b, c);
        Vec3 best = closest_on_segment(p, a, b);
        for (const Vec3& q : {closest_on_segment(p, b, c), closest_on_segment(p, c, a)}) {
            if ((q - p).squaredNorm() < (best - p).squaredNorm()) best = q;
        }
        return best;
    }
};

std::vector<StoredTriangle> store(const TriangleMesh& mesh) {
    require_sound(mesh);
    if (mesh.faces.empty()) {
        throw GeometryError("surface.empty", "surface", "the mesh has no faces",
                            "at least one is needed for a distance");
    }
    std::vector<StoredTriangle> out;
    out.reserve(mesh.faces.size());
    for (const auto& f : mesh.faces) {
        const Vec3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        out.push_back({a, b, c, is_degenerate(a, b, c)});
    }
    return out;
}

std::vector<Vec3> store(std::span<const Vec3> points) {
    if (points.empty()) {
        throw GeometryError("surface.empty", "points", "the set is empty",
                            "at least one point is needed for a distance");
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].allFinite()) continue;
        throw GeometryError("surface.not_finite", "points",
                            fmt::format("point {} is NaN or infinite", i), "remove it");
    }
    return {points.begin(), points.end()};
}

template <class Item, class BoxOf>
std::vector<Box3> boxes_of(const std::vector<Item>& items, BoxOf&& box_of) {
    std::vector<Box3> boxes;
    boxes.reserve(items.size());
    for (const Item& item : items) boxes.push_back(box_of(item));
    return boxes;
}

}  // namespace

struct TriangleTree::Data {
    std::vector<StoredTriangle> triangles;
    BoxTree tree;
    explicit Data(const TriangleMesh& mesh)
        : triangles(store(mesh)),
          tree(boxes_of(triangles, [](const StoredTriangle& t) { return t.box(); })) {}
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) : data_(std::make_unique<Data>(mesh)) {}
TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

NearestHit TriangleTree::nearest(const Vec3& p) const {
    const auto best = data_->tree.nearest(
        p, [&](std::uint32_t i) { return (data_->triangles[i].closest(p) - p).squaredNorm(); });
    const Vec3 point = data_->triangles[best.item].closest(p);
    return {point, (point - p).norm(), best.item};
}

struct PointTree::Data {
    std::vector<Vec3> points;
    BoxTree tree;
    explicit Data(std::span<const Vec3> from)
        : points(store(from)), tree(boxes_of(points, [](const Vec3& p) {
              return Box3{p, p};
          })) {}
};

PointTree::PointTree(std::span<const Vec3> points) : data_(std::make_unique<Data>(points)) {}
PointTree::~PointTree() = default;
PointTree::PointTree(PointTree&&) noexcept = default;
PointTree& PointTree::operator=(PointTree&&) noexcept = default;

NearestHit PointTree::nearest(const Vec3& p) const {
    const auto best = data_->tree.nearest(
        p, [&](std::uint32_t i) { return (data_->points[i] - p).squaredNorm(); });
    const Vec3 point = data_->points[best.item];
    return {point, (point - p).norm(), best.item};
}

}  // namespace dsc::surface
