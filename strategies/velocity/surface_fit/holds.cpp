#include "holds.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

namespace dsc::strategies::fit {
namespace {

constexpr std::size_t hold_block = 512;  // vertices

Vec3 common_normal(const surface::SurfaceView& view, std::size_t v) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const std::uint32_t f : view.faces_of(v)) {
        const Vec3& n = view.face_normals[f];
        sum += view.face_areas[f] * n * n.transpose();
    }
    const double scale = sum.trace();
    if (!(scale > 0.0)) return Vec3::Zero();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum / scale).eigenvectors().col(2);
}

}  // namespace

void measure_holds(const surface::SurfaceView& view, std::span<const double> lengths, double along,
                   double across, Workers* workers, std::vector<Hold>& holds) {
    holds.resize(view.vertex_count());
    for_blocks(workers, holds.size(), hold_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            holds[v] = {along * lengths[v] * lengths[v],
                        std::sqrt(along - across) * lengths[v] * common_normal(view, v)};
        }
    });
}

}  // namespace dsc::strategies::fit
