#include "mean_curvature.hpp"

#include <algorithm>
#include <cmath>

namespace dsc::strategies::fit {
namespace {

constexpr unsigned ring_rounds = 3;    // rounds of sums over rings: noise in the angles cancels
constexpr double largest_angle = 0.5;  // radians: larger angles belong to creases, not to curvature
constexpr std::size_t curvature_block = 1024;  // vertices

/// Numerator and denominator of the curvature.
struct BentArea {
    double bend = 0.0;
    double area = 0.0;
};

double angle_of(const surface::SurfaceView& view, const Hinge& hinge) {
    const Vec3 edge = view.positions[hinge.vertices[1]] - view.positions[hinge.vertices[0]];
    const double sine =
        half_sine(view.face_normals[hinge.faces[0]], view.face_normals[hinge.faces[1]], edge);
    return std::clamp(2.0 * std::asin(std::clamp(sine, -1.0, 1.0)), -largest_angle, largest_angle) *
           edge.norm();
}

}  // namespace

void measure_curvature(const surface::SurfaceView& view, const SurfaceLinks& links, double largest,
                       Workers* workers, std::vector<double>& curvature) {
    const std::size_t count = view.vertex_count();
    std::vector<BentArea> sums(count);
    for (const Hinge& hinge : links.hinges) {
        const double bend = 0.25 * angle_of(view, hinge);
        sums[hinge.vertices[0]].bend += bend;
        sums[hinge.vertices[1]].bend += bend;
    }
    for (std::size_t v = 0; v < count; ++v) {
        for (const std::uint32_t f : view.faces_of(v)) sums[v].area += view.face_areas[f] / 3.0;
    }
    std::vector<BentArea> before(count);
    for (unsigned round = 0; round < ring_rounds; ++round) {
        std::swap(before, sums);
        for_blocks(workers, count, curvature_block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t v = begin; v < end; ++v) {
                BentArea sum = before[v];
                for (const std::uint32_t w : links.neighbours_of(v)) {
                    sum.bend += before[w].bend;
                    sum.area += before[w].area;
                }
                sums[v] = sum;
            }
        });
    }
    curvature.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
        curvature[v] =
            sums[v].area > 0.0 ? std::clamp(sums[v].bend / sums[v].area, -largest, largest) : 0.0;
    }
}

}  // namespace dsc::strategies::fit
