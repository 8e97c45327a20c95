// Widths, spread, regularity and noise of a cloud.
#include "dsc/cloud/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <dsc/cloud/search.hpp>
#include <dsc/geometry/order.hpp>

#include "neighbours.hpp"

namespace dsc::cloud {

namespace {

constexpr std::size_t statistics_block = 512;  // points per block; constant, so that the result
                                               // does not depend on the threads
constexpr std::size_t point_neighbours = 12;   // of point_width
constexpr std::size_t label_neighbours = 8;    // of label_width and outlier_score
constexpr std::size_t noise_probes = 2000;     // places where the noise is measured
constexpr double noise_quantile = 0.3;  // of the probes: most of them, but not those at creases
constexpr std::size_t quadric_coefficients = 6;  // of a quadric

/// A neighbourhood in which the noise is measured, and the 0.3-quantile of chi^2 / m with m =
/// points - 6.
struct Neighbourhood {
    std::size_t points;
    double chi_square;
};
constexpr std::array<Neighbourhood, 3> neighbourhoods = {{{12, 0.638}, {18, 0.753}, {24, 0.802}}};

/// The value below which a fraction `at` of the values lies: the sorted value at the rounded-down
/// position.
double quantile(std::vector<double> values, double at) {
    if (values.empty()) return 0.0;
    const auto n = static_cast<std::ptrdiff_t>(at * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + n, values.end());
    return values[static_cast<std::size_t>(n)];
}

/// Mean square distance between points and their best-fitting quadric z(x, y), in the frame of
/// their plane: the sum of squares over the degrees of freedom. Distances are in units of `reach`.
double quadric_residual(std::span<const Vec3> points, std::span<const Neighbour> members,
                        double reach) {
    const auto count = static_cast<Eigen::Index>(members.size());
    Eigen::MatrixX3d local(count, 3);
    for (Eigen::Index n = 0; n < count; ++n) {
        local.row(n) =
            (points[members[static_cast<std::size_t>(n)].index] - points[members.front().index])
                .transpose() /
            reach;
    }
    const Eigen::RowVector3d mean = local.colwise().mean();
    local.rowwise() -= mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(local.transpose() * local);
    // columns: across the plane, then along it
    const Eigen::MatrixX3d in_frame = local * axes.eigenvectors();
    Eigen::MatrixXd terms(count, static_cast<Eigen::Index>(quadric_coefficients));
    for (Eigen::Index n = 0; n < count; ++n) {
        const double x = in_frame(n, 1), y = in_frame(n, 2);
        terms.row(n) << 1.0, x, y, x * x, x * y, y * y;
    }
    const Eigen::VectorXd z = in_frame.col(0);
    const Eigen::VectorXd fit = terms.colPivHouseholderQr().solve(z);
    return (terms * fit - z).squaredNorm() /
           static_cast<double>(members.size() - quadric_coefficients);
}

/// Noise as estimated with one size of neighbourhood; infinite if it cannot be estimated.
double noise_of(const NearestSearch& search, const Neighbourhood& size, Workers* workers) {
    const std::span<const Vec3> points = search.points();
    if (points.size() < size.points) return INFINITY;
    const std::size_t probes = std::min(points.size(), noise_probes);
    std::vector<double> squares(probes, 0.0);
    for_blocks(workers, probes, 64, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour> members;
        for (std::size_t n = begin; n < end; ++n) {
            search.k_nearest(points[n * points.size() / probes], size.points, members);
            const double reach = members.back().distance;
            if (reach > 0.0) squares[n] = quadric_residual(points, members, reach) * reach * reach;
        }
    });
    return std::sqrt(quantile(std::move(squares), noise_quantile) / size.chi_square);
}

/// Distances to the neighbours from which widths are computed, as many as there are.
struct Reaches {
    std::vector<double> nearest, point, label;
    std::vector<std::uint32_t> neighbours;  ///< label_neighbours per point; the point itself where
                                            ///< there are fewer
};

Reaches measure_reaches(const NearestSearch& search, Workers* workers) {
    const std::span<const Vec3> points = search.points();
    Reaches out;
    out.nearest.resize(points.size());
    out.point.resize(points.size());
    out.label.resize(points.size());
    out.neighbours.resize(points.size() * label_neighbours);
    // Consecutive points are close to each other, so the searches use the caches well.
    const std::vector<std::uint32_t> order = spatial_order(points);
    for_blocks(workers, points.size(), statistics_block, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour> found;
        for (std::size_t q = begin; q < end; ++q) {
            const std::size_t i = order[q];
            search.k_nearest(points[i], point_neighbours + 1, found);
            // The point itself comes first, or a coinciding point at the same distance.
            out.nearest[i] = found[std::min<std::size_t>(1, found.size() - 1)].distance;
            out.point[i] = found.back().distance;
            out.label[i] = found[std::min(label_neighbours, found.size() - 1)].distance;
            for (std::size_t n = 0; n < label_neighbours; ++n) {
                out.neighbours[i * label_neighbours + n] =
                    n + 1 < found.size() ? found[n + 1].index : static_cast<std::uint32_t>(i);
            }
        }
    });
    return out;
}

std::size_t count_duplicates(std::span<const Vec3> points) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        return geometry::lexicographically_before(points[i], points[j]);
    });
    std::size_t count = 0;
    for (std::size_t n = 1; n < order.size(); ++n)
        count += points[order[n]] == points[order[n - 1]] ? 1U : 0U;
    return count;
}

}  // namespace

double width_of(double distance, double neighbours) {
    return distance * std::sqrt(std::acos(-1.0) / neighbours);
}

double certain_noise(double noise_ratio) {
    if (noise_ratio >= noise_certain) return noise_ratio;
    return noise_certain * std::max(0.0, noise_ratio - noise_floor) / (noise_certain - noise_floor);
}

double vertex_budget(std::size_t points, Detail detail) {
    constexpr double few = 3000.0, many = 20000.0;
    const double factor = detail == Detail::low ? 0.5 : (detail == Detail::high ? 2.0 : 1.0);
    const auto n = static_cast<double>(points);
    if (n <= few) return factor * 2.0 * n;
    if (n <= many) return factor * (2.0 * few + (many - 2.0 * few) * (n - few) / (many - few));
    return factor * many * std::sqrt(n / many);
}

Statistics measure_cloud(std::span<const Vec3> points, Workers* workers) {
    return measure_cloud(NearestSearch(points), workers);
}

Statistics measure_cloud(const NearestSearch& search, Workers* workers) {
    const std::span<const Vec3> points = search.points();
    const std::size_t count = points.size();
    const Reaches reach = measure_reaches(search, workers);
    const auto others =
        static_cast<double>(std::min(point_neighbours, std::max<std::size_t>(count, 2) - 1));
    const auto label_others =
        static_cast<double>(std::min(label_neighbours, std::max<std::size_t>(count, 2) - 1));

    Statistics out;
    out.point_width.resize(count);
    out.label_width.resize(count);
    out.outlier_score.resize(count);
    for_blocks(workers, count, statistics_block, [&](std::size_t begin, std::size_t end) {
        std::array<double, label_neighbours> around{};
        for (std::size_t i = begin; i < end; ++i) {
            out.point_width[i] = width_of(reach.point[i], others);
            double sum = reach.label[i];
            for (std::size_t n = 0; n < label_neighbours; ++n) {
                around[n] = reach.label[reach.neighbours[i * label_neighbours + n]];
                sum += around[n];
            }
            out.label_width[i] =
                width_of(sum / static_cast<double>(label_neighbours + 1), label_others + 0.5);
            std::nth_element(around.begin(), around.begin() + label_neighbours / 2, around.end());
            const double median = around[label_neighbours / 2];
            out.outlier_score[i] =
                median > 0.0 ? reach.label[i] / median : (reach.label[i] > 0.0 ? INFINITY : 1.0);
        }
    });
    out.width = quantile(out.point_width, 0.5);
    out.median_label_width = quantile(out.label_width, 0.5);
    const double narrow = quantile(out.point_width, 0.1), wide = quantile(out.point_width, 0.9);
    out.spread = narrow > 0.0 ? wide / narrow : (wide > 0.0 ? INFINITY : 1.0);
    for (const double h : out.point_width) {
        const double width = std::min(h, 2.0 * out.width);
        out.area += width * width;
    }
    double ratios = 0.0;
    std::size_t wide_points = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!(out.point_width[i] > 0.0)) continue;
        ratios += reach.nearest[i] / (0.5 * out.point_width[i]);
        ++wide_points;
    }
    if (wide_points > 0) out.regularity = ratios / static_cast<double>(wide_points);
    double noise = INFINITY;
    for (const Neighbourhood& size : neighbourhoods)
        noise = std::min(noise, noise_of(search, size, workers));
    out.noise = std::isfinite(noise) ? noise : 0.0;
    out.noise_ratio = out.width > 0.0 ? out.noise / out.width : 0.0;
    out.duplicates = count_duplicates(points);
    return out;
}

}  // namespace dsc::cloud
