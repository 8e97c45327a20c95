#include "comparison.hpp"

#include <algorithm>
#include <cmath>

#include <dsc/geometry/quality.hpp>
#include <dsc/surface/distance.hpp>

namespace dsc::strategies {
namespace {

/// Every face is split into the square of this number of equal parts, which are represented by
/// their centroids.
constexpr int parts_an_edge = 3;

using Corners = std::array<Vec3, 3>;

Corners corners_of(const surface::TriangleMesh& mesh, const std::array<std::uint32_t, 3>& face) {
    return {mesh.points[face[0]], mesh.points[face[1]], mesh.points[face[2]]};
}

template <class Visit>
void for_part_centroids(const Corners& p, Visit visit) {
    const auto at = [&](double u, double v) {
        return Vec3(p[0] + u / parts_an_edge * (p[1] - p[0]) + v / parts_an_edge * (p[2] - p[0]));
    };
    for (int i = 0; i < parts_an_edge; ++i) {
        for (int j = 0; i + j < parts_an_edge; ++j) {
            visit(at(i + 1.0 / 3, j + 1.0 / 3));
            if (i + j + 1 < parts_an_edge) visit(at(i + 2.0 / 3, j + 2.0 / 3));
        }
    }
}

/// The mean of a function of a point over the area of the mesh.
template <class Function>
double mean_over(const surface::TriangleMesh& mesh, Function function) {
    double sum = 0.0;
    double area = 0.0;
    for (const auto& face : mesh.faces) {
        const Corners p = corners_of(mesh, face);
        const double face_area = geometry::triangle_area(p[0], p[1], p[2]);
        double of_face = 0.0;
        for_part_centroids(p, [&](const Vec3& point) { of_face += function(point); });
        sum += face_area * of_face / (parts_an_edge * parts_an_edge);
        area += face_area;
    }
    return area > 0 ? sum / area : 0.0;
}

double mean_to(const surface::TriangleMesh& from, const surface::TriangleMesh& to) {
    const surface::TriangleTree tree(to);
    return mean_over(from, [&](const Vec3& p) { return tree.nearest(p).distance; });
}

}  // namespace

SphereComparison compare_with_sphere(const surface::TriangleMesh& mesh, const Vec3& centre,
                                     double radius) {
    SphereComparison out;
    double weighted = 0.0;
    double area = 0.0;
    for (const auto& face : mesh.faces) {
        const Corners p = corners_of(mesh, face);
        const double face_area = geometry::triangle_area(p[0], p[1], p[2]);
        double sum = 0.0;
        for (const Vec3& corner : p) {
            const double distance = (corner - centre).norm();
            sum += distance;
            out.largest_distance = std::max(out.largest_distance, distance - radius);
        }
        weighted += face_area * sum / 3;
        area += face_area;
        const Vec3 nearest = geometry::closest_point_on_triangle(centre, p[0], p[1], p[2]);
        out.largest_distance = std::max(out.largest_distance, radius - (nearest - centre).norm());
    }
    if (area > 0) out.radius = weighted / area;
    out.mean_distance =
        mean_over(mesh, [&](const Vec3& p) { return std::abs((p - centre).norm() - radius); });
    return out;
}

double mean_distance(const surface::TriangleMesh& a, const surface::TriangleMesh& b) {
    return std::max(mean_to(a, b), mean_to(b, a));
}

}  // namespace dsc::strategies
