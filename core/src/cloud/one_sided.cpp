// Recognises clouds recorded from one side, and closes them with a copy.
#include "one_sided.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

namespace dsc::cloud {

namespace {

constexpr std::size_t least_samples = 100;
constexpr double footprint_cell = 2.0;  // widths: few cells of the footprint are empty by chance
constexpr double layer_cell = 4.0;      // widths
constexpr double layer_gap = 6.0;  // widths: larger than any evenly sampled slope within a cell
constexpr double least_area_ratio = 0.6;  // less for walls that are parallel to the view
constexpr double most_area_ratio = 1.3;   // 1 for one layer; 2 for solids, somewhat less if sampled
                                          // sparsely
constexpr double most_layered_share = 0.1;  // edges of roofs, and objects in front of others
// angle without neighbours: 180 degrees at a straight border
constexpr double rim_gap = 165.0 / 180.0 * std::numbers::pi;
constexpr double least_rim = 0.25;  // of the shortest possible border, the circumference of a disc
                                    // of equal area
constexpr double least_depth = 20.0;     // widths
constexpr double depth_of_extent = 0.2;  // square roots of the footprint
constexpr double most_depth = 0.25;  // of the longest side of the box: the copy stays in the box of
                                     // the simulation
constexpr double copy_narrowing = 0.15;  // of the distance from the centre
constexpr double along_view = 0.7;  // cosine: a camera at the origin looks along it; terrain is
                                    // across the z axis
constexpr double farthest_camera = 10.0;  // diagonals from the cloud's centre

/// Two unit vectors perpendicular to a third one.
std::pair<Vec3, Vec3> across(const Vec3& direction) {
    Eigen::Index least = 0;
    direction.cwiseAbs().minCoeff(&least);
    const Vec3 first = direction.cross(Vec3::Unit(least)).normalized();
    return {first, direction.cross(first)};
}

struct InCell {
    std::int64_t u, v;  // cell in the plane perpendicular to the direction
    double depth;       // along it
};

/// Samples by the cells that lines along `direction` cross, nearest first in each cell.
std::vector<InCell> project(const ScaledSamples& samples, const Vec3& direction, double cell) {
    const auto [a, b] = across(direction);
    std::vector<InCell> out;
    out.reserve(samples.size());
    for (const Vec3& p : samples.positions) {
        out.push_back({static_cast<std::int64_t>(std::floor(p.dot(a) / cell)),
                       static_cast<std::int64_t>(std::floor(p.dot(b) / cell)), p.dot(direction)});
    }
    std::sort(out.begin(), out.end(), [](const InCell& l, const InCell& r) {
        return std::make_pair(std::make_pair(l.u, l.v), l.depth) <
               std::make_pair(std::make_pair(r.u, r.v), r.depth);
    });
    return out;
}

bool same_cell(const InCell& l, const InCell& r) { return l.u == r.u && l.v == r.v; }

double footprint(const ScaledSamples& samples, const Vec3& direction) {
    const double cell = footprint_cell * samples.width;
    const std::vector<InCell> projected = project(samples, direction, cell);
    std::size_t cells = 0;
    for (std::size_t i = 0; i < projected.size(); ++i)
        cells += i == 0 || !same_cell(projected[i - 1], projected[i]) ? 1 : 0;
    return static_cast<double>(cells) * cell * cell;
}

double layered_share(const ScaledSamples& samples, const Vec3& direction) {
    const std::vector<InCell> projected = project(samples, direction, layer_cell * samples.width);
    std::size_t cells = 0, layered = 0;
    for (std::size_t begin = 0, end = 0; begin < projected.size(); begin = end) {
        bool apart = false;
        for (end = begin + 1; end < projected.size() && same_cell(projected[begin], projected[end]);
             ++end)
            apart = apart ||
                    projected[end].depth - projected[end - 1].depth > layer_gap * samples.width;
        ++cells;
        layered += apart ? 1 : 0;
    }
    return static_cast<double>(layered) / static_cast<double>(cells);
}

/// Area of the samples as seen along a direction.
double seen_area(const ScaledSamples& samples, const Vec3& direction) {
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double width = std::min(samples.widths[i], 2.0 * samples.width);
        sum += width * width * std::abs(samples.normals[i].dot(direction));
    }
    return sum;
}

/// Whether the neighbours leave half of the tangent plane empty: the sample lies at a border.
bool at_rim(const ScaledSamples& samples, std::size_t s, std::vector<double>& angles) {
    const auto [a, b] = across(samples.normals[s]);
    angles.clear();
    for (const std::uint32_t n : samples.neighbours.of(s)) {
        const Vec3 way = samples.positions[n] - samples.positions[s];
        angles.push_back(std::atan2(way.dot(b), way.dot(a)));
    }
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 2.0 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) gap = std::max(gap, angles[i] - angles[i - 1]);
    return gap > rim_gap;
}

/// Approximate length of all borders; a solid has none.
double rim_length(const ScaledSamples& samples) {
    double length = 0.0;
    std::vector<double> angles;
    for (std::size_t s = 0; s < samples.size(); ++s)
        length += at_rim(samples, s, angles) ? samples.width : 0.0;
    return length;
}

/// The principal axes; the axes, diagonals and edge directions of a cube; and the direction from
/// the origin.
std::vector<Vec3> candidates(const ScaledSamples& samples, const Vec3& mean, const Vec3& origin) {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& p : samples.positions) spread += (p - mean) * (p - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    std::vector<Vec3> all;
    for (int k = 0; k < 3; ++k) all.emplace_back(axes.eigenvectors().col(k));
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = 0; z <= 1; ++z) {
                // one of each pair of opposite directions
                const bool half = z > 0 || y > 0 || (y == 0 && x > 0);
                if (half) all.push_back(Vec3(x, y, z).normalized());
            }
    if ((mean - origin).norm() > 0.0) all.push_back((mean - origin).normalized());
    return all;
}

/// Which of the two directions along `direction` leads away from the recorder: away from a camera
/// at the origin; else downwards, for a recording from the air; else towards the border, because
/// objects bulge towards the viewer.
Vec3 turned_away(const ScaledSamples& samples, const Vec3& direction, const Vec3& mean,
                 const Vec3& origin) {
    const Vec3 way = mean - origin;
    const double along = way.norm() > 0.0 ? way.normalized().dot(direction) : 0.0;
    const bool outside = (origin.array().abs() > 0.5).any() && way.norm() < farthest_camera;
    if (outside && std::abs(along) > along_view) return along > 0.0 ? direction : Vec3(-direction);
    if (std::abs(direction.z()) > along_view)
        return direction.z() < 0.0 ? direction : Vec3(-direction);
    double bulge = 0.0, square = 0.0;
    for (const Vec3& p : samples.positions)
        square += (p - mean).squaredNorm() / static_cast<double>(samples.size());
    for (const Vec3& p : samples.positions)
        bulge += (p - mean).dot(direction) * ((p - mean).squaredNorm() - square);
    return bulge >= 0.0 ? direction : Vec3(-direction);
}

}  // namespace

std::optional<OneSided> find_one_sided(const ScaledSamples& samples, const Vec3& origin) {
    if (samples.size() < least_samples || !(samples.width > 0.0)) return std::nullopt;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : samples.positions) mean += p;
    mean /= static_cast<double>(samples.size());

    Vec3 low = samples.positions.front(), high = low;
    for (const Vec3& p : samples.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double deepest = most_depth * (high - low).maxCoeff();

    const double rim = rim_length(samples);
    std::optional<OneSided> best;
    for (const Vec3& direction : candidates(samples, mean, origin)) {
        const double area = footprint(samples, direction);
        const double ratio = seen_area(samples, direction) / area;
        if (!(ratio > least_area_ratio && ratio < most_area_ratio) ||
            rim < least_rim * 2.0 * std::sqrt(std::numbers::pi * area))
            continue;
        const double layered = layered_share(samples, direction);
        if (!(layered < most_layered_share) || (best && layered >= best->layered_share)) continue;
        const double depth = std::min(
            deepest, std::max(least_depth * samples.width, depth_of_extent * std::sqrt(area)));
        best = OneSided{turned_away(samples, direction, mean, origin), depth, ratio, layered};
    }
    return best;
}

Vec3 backing_of(const ScaledSamples& samples, const Vec3& origin, const std::optional<Vec3>& away) {
    const std::optional<OneSided> found = find_one_sided(samples, origin);
    if (!found) return Vec3::Zero();
    return found->depth * samples.diagonal * away.value_or(found->away);
}

std::vector<Vec3> with_copy(std::span<const Vec3> points, const Vec3& backing) {
    std::vector<Vec3> all(points.begin(), points.end());
    const Vec3 away = backing.normalized(), centre = bounding_box(points).centre();
    for (const Vec3& p : points) {
        const Vec3 from_centre = p - centre;
        all.emplace_back(p + backing -
                         copy_narrowing * (from_centre - from_centre.dot(away) * away));
    }
    return all;
}

void leave_out_copy(std::size_t count, const Vec3& backing, OrientedPoints& found) {
    found.normals.resize(count);
    found.areas.resize(count);
    found.confidence.resize(count);
    found.orientation.backing = backing;
}

}  // namespace dsc::cloud
