// Normals and noise from the neighbours of points.
#include "local_shape.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <dsc/base/median.hpp>

namespace dsc::cloud {

namespace {

constexpr std::size_t shape_block = 128;
constexpr std::size_t most_members = 32;
constexpr std::size_t coefficients = 6;
constexpr std::size_t most_probes = 3000;

using Members = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most_members, 3>;
using QuadricTerms = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, most_members, 6>;
using Heights = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_members, 1>;

/// A point and its neighbours relative to their mean, scaled to a size of about 1.
struct LocalPatch {
    Members members;
    double size = 0.0;
};

LocalPatch patch_at(std::span<const Vec3> points, const Neighbours& neighbours, std::size_t i) {
    const auto around = neighbours.of(i);
    const std::size_t count = std::min(around.size() + 1, most_members);
    LocalPatch patch{Members(static_cast<Eigen::Index>(count), 3)};
    patch.members.row(0).setZero();
    for (std::size_t n = 1; n < count; ++n)
        patch.members.row(static_cast<Eigen::Index>(n)) =
            (points[around[n - 1]] - points[i]).transpose();
    const Eigen::RowVector3d mean = patch.members.colwise().mean();
    patch.members.rowwise() -= mean;
    patch.size = patch.members.cwiseAbs().maxCoeff();
    if (patch.size > 0.0) patch.members /= patch.size;
    return patch;
}

/// Axes of least, middle and largest spread, as columns.
Eigen::Matrix3d axes_of(const LocalPatch& patch) {
    const Eigen::Matrix3d spread = patch.members.transpose() * patch.members;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
}

double quadric_residual(const LocalPatch& patch) {
    const Members local = patch.members * axes_of(patch);
    QuadricTerms terms(local.rows(), static_cast<Eigen::Index>(coefficients));
    for (Eigen::Index n = 0; n < local.rows(); ++n) {
        const double x = local(n, 1), y = local(n, 2);
        terms.row(n) << 1.0, x, y, x * x, x * y, y * y;
    }
    const Heights heights = local.col(0);
    const Heights residual = heights - terms * terms.colPivHouseholderQr().solve(heights);
    return patch.size *
           std::sqrt(residual.squaredNorm() /
                     static_cast<double>(static_cast<std::size_t>(local.rows()) - coefficients));
}

}  // namespace

std::vector<Vec3> plane_normals(std::span<const Vec3> points, const Neighbours& neighbours,
                                Workers* workers) {
    std::vector<Vec3> normals(points.size());
    for_blocks(workers, points.size(), shape_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            normals[i] = axes_of(patch_at(points, neighbours, i)).col(0);
    });
    return normals;
}

double quadric_noise(std::span<const Vec3> points, const Neighbours& neighbours, Workers* workers) {
    if (neighbours.each + 1 <= coefficients) return 0.0;
    std::vector<double> residuals(std::min(points.size(), most_probes));
    for_blocks(workers, residuals.size(), shape_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n)
            residuals[n] = quadric_residual(
                patch_at(points, neighbours, n * points.size() / residuals.size()));
    });
    return median_of(std::move(residuals));
}

}  // namespace dsc::cloud
