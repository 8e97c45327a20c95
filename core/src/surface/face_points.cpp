// The nearest faces of points, and the barycentric weights there.
#include "dsc/surface/face_points.hpp"

#include <algorithm>

#include <dsc/surface/distance.hpp>

namespace dsc::surface {
namespace {

constexpr std::size_t block = 256;

// Along the longest side of a triangle without area.
std::array<double, 3> weights_on_side(const std::array<Vec3, 3>& corners, const Vec3& p) {
    unsigned side = 0;
    double longest = -1.0;
    for (unsigned k = 0; k < 3; ++k) {
        const double length2 = (corners[(k + 1) % 3] - corners[k]).squaredNorm();
        if (length2 <= longest) continue;
        longest = length2;
        side = k;
    }
    const Vec3 along = corners[(side + 1) % 3] - corners[side];
    const double s =
        longest > 0.0 ? std::clamp((p - corners[side]).dot(along) / longest, 0.0, 1.0) : 0.0;
    std::array<double, 3> weights{};
    weights[side] = 1.0 - s;
    weights[(side + 1) % 3] = s;
    return weights;
}

// Barycentric coordinates of a point of the triangle.
std::array<double, 3> weights_of(const std::array<Vec3, 3>& corners, const Vec3& p) {
    const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double area2 = normal.squaredNorm();
    double scale = 0.0;
    for (unsigned k = 0; k < 3; ++k)
        scale = std::max(scale, (corners[(k + 1) % 3] - corners[k]).squaredNorm());
    if (!(area2 > 1e-20 * scale * scale)) return weights_on_side(corners, p);
    std::array<double, 3> weights{};
    double sum = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
        const Vec3 &a = corners[(k + 1) % 3], &b = corners[(k + 2) % 3];
        weights[k] = std::max(0.0, (a - p).cross(b - p).dot(normal) / area2);
        sum += weights[k];
    }
    for (double& w : weights) w /= sum;
    return weights;
}

}  // namespace

void nearest_faces(const SurfaceView& view, std::span<const Vec3> points,
                   std::vector<FacePoint>& out, Workers* workers) {
    out.clear();
    if (view.face_count() == 0) return;
    out.resize(points.size());
    const TriangleTree tree(TriangleMesh{view.positions, view.faces});
    for_blocks(workers, points.size(), block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const NearestHit hit = tree.nearest(points[i]);
            const auto& [a, b, c] = view.faces[hit.index];
            out[i] = {
                hit.index,
                weights_of({view.positions[a], view.positions[b], view.positions[c]}, hit.point),
                hit.distance};
        }
    });
}

}  // namespace dsc::surface
