// Sizes, normals and cleaning of triangle meshes.
#include "dsc/surface/measure.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/geometry/quality.hpp>

namespace dsc::surface {
namespace {

std::array<double, 3> key_of(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

double angle_at(const Vec3& apex, const Vec3& a, const Vec3& b) {
    const Vec3 u = a - apex, v = b - apex;
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

void require_sound(const TriangleMesh& mesh) {
    const std::size_t count = mesh.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (mesh.points[i].allFinite()) continue;
        throw GeometryError("surface.not_finite", "surface",
                            fmt::format("point {} is NaN or infinite", i),
                            "remove it or repair the file");
    }
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        for (const std::uint32_t v : mesh.faces[f]) {
            if (v < count) continue;
            throw GeometryError("surface.index", "surface",
                                fmt::format("face {} refers to point {} of {}", f, v, count),
                                "remove the face or add the point");
        }
    }
}

double area(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.faces) {
        sum += geometry::triangle_area(mesh.points[a], mesh.points[b], mesh.points[c]);
    }
    return sum;
}

double mean_edge(std::span<const Vec3> points,
                 std::span<const std::array<std::uint32_t, 3>> faces) {
    double sum = 0.0;
    for (const auto& [a, b, c] : faces) {
        sum += (points[b] - points[a]).norm() + (points[c] - points[b]).norm() +
               (points[a] - points[c]).norm();
    }
    return faces.empty() ? 0.0 : sum / static_cast<double>(3 * faces.size());
}

double volume(const TriangleMesh& mesh) {
    if (mesh.faces.empty()) return 0.0;
    // Relative to the centre, so that a small mesh far from the origin keeps its digits.
    const Vec3 centre = used_box(mesh).centre();
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.faces) {
        const Vec3 p = mesh.points[a] - centre, q = mesh.points[b] - centre,
                   r = mesh.points[c] - centre;
        sum += p.dot(q.cross(r));
    }
    return sum / 6.0;
}

Box3 used_box(const TriangleMesh& mesh) {
    Box3 box;
    for (const auto& face : mesh.faces) {
        for (const std::uint32_t v : face) box.extend(mesh.points[v]);
    }
    return box;
}

std::vector<Vec3> face_normals(const TriangleMesh& mesh) {
    std::vector<Vec3> normals;
    normals.reserve(mesh.faces.size());
    for (const auto& [a, b, c] : mesh.faces) {
        normals.push_back(
            geometry::triangle_normal(mesh.points[a], mesh.points[b], mesh.points[c]));
    }
    return normals;
}

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
    std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
    for (const auto& face : mesh.faces) {
        const std::array<Vec3, 3> p = {mesh.points[face[0]], mesh.points[face[1]],
                                       mesh.points[face[2]]};
        const Vec3 normal = geometry::triangle_normal(p[0], p[1], p[2]);
        for (std::size_t k = 0; k < 3; ++k)
            normals[face[k]] += angle_at(p[k], p[(k + 1) % 3], p[(k + 2) % 3]) * normal;
    }
    for (Vec3& n : normals) {
        const double length = n.norm();
        n = length > 0.0 ? Vec3(n / length) : Vec3(Vec3::Zero());
    }
    return normals;
}

std::vector<std::uint32_t> first_equal(std::span<const Vec3> points) {
    // The coordinates are sorted together with the indices; looking them up would cause a cache
    // miss in every comparison.
    std::vector<std::pair<std::array<double, 3>, std::uint32_t>> order;
    order.reserve(points.size());
    for (const Vec3& p : points)
        order.emplace_back(key_of(p), static_cast<std::uint32_t>(order.size()));
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> first(points.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const bool same = k > 0 && order[k].first == order[k - 1].first;
        first[order[k].second] = same ? first[order[k - 1].second] : order[k].second;
    }
    return first;
}

TriangleMesh weld(const TriangleMesh& mesh) {
    const std::vector<std::uint32_t> first = first_equal(mesh.points);
    TriangleMesh out;
    std::vector<bool> used(mesh.points.size(), false);
    for (const auto& face : mesh.faces) {
        const std::array<std::uint32_t, 3> f = {first[face[0]], first[face[1]], first[face[2]]};
        if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
        out.faces.push_back(f);
        for (const std::uint32_t v : f) used[v] = true;
    }
    std::vector<std::uint32_t> renumbered(mesh.points.size(), 0);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (!used[i]) continue;
        renumbered[i] = static_cast<std::uint32_t>(out.points.size());
        out.points.push_back(mesh.points[i]);
    }
    for (auto& face : out.faces) {
        for (std::uint32_t& v : face) v = renumbered[v];
    }
    return out;
}

}  // namespace dsc::surface
