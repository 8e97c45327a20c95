// Filter `hidden`: discs that represent the surface are drawn into depth buffers from many
// directions.
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/text/numbers.hpp>

#include "filtering.hpp"

namespace dsc::cloud {

namespace {

/// A disc that represents the surface at a point.
struct Disc {
    Vec3 centre;
    Vec3 normal;  ///< unit, of either sign
    double radius = 0.0;
    double margin = 0.0;  ///< the disc does not hide points that are less than this behind it
};

/// Normal of the best-fitting plane of the points.
Vec3 plane_normal(std::span<const Vec3> points, std::span<const Neighbour> members) {
    Vec3 mean = Vec3::Zero();
    for (const Neighbour& n : members)
        mean += points[n.index] / static_cast<double>(members.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Neighbour& n : members)
        spread += (points[n.index] - mean) * (points[n.index] - mean).transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
}

double median_radius(const std::vector<Disc>& discs) {
    std::vector<double> radii;
    radii.reserve(discs.size());
    for (const Disc& disc : discs) radii.push_back(disc.radius);
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    return *middle;
}

/// The disc of every point; the origin is the centre of the cloud's box.
std::vector<Disc> discs_of(const Cloud& cloud, const Vec3& origin, const HiddenOptions& options) {
    constexpr std::size_t members = 9;  // the point and eight others
    Normalized recentred;
    recentred.points.reserve(cloud.points.size());
    for (const Vec3& p : cloud.points) recentred.points.emplace_back(p - origin);
    const TargetCloud target(recentred);
    std::vector<Disc> discs;
    discs.reserve(target.size());
    std::vector<Neighbour> near;
    for (std::size_t i = 0; i < target.size(); ++i) {
        target.search().k_nearest(target[i], members, near);
        const double distance = target.neighbour_distance(i);
        discs.push_back({target[i], plane_normal(target.points(), near), options.radius * distance,
                         options.depth * distance});
    }
    // Isolated points do not represent a surface of that width.
    constexpr double widest = 4.0;
    const double limit = widest * median_radius(discs);
    for (Disc& disc : discs) disc.radius = std::min(disc.radius, limit);
    return discs;
}

/// Directions spread evenly over the sphere, along a spiral.
Vec3 direction(std::size_t i, std::size_t count) {
    const double pi = std::acos(-1.0), golden = 0.5 * (1.0 + std::sqrt(5.0));
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double angle = 2.0 * pi * static_cast<double>(i) / golden;
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

/// What a viewer at infinity sees: the largest depth (towards the viewer) per pixel.
class DepthBuffer {
public:
    /// `half_width`: of the visible square. `pixel`: wanted edge of a pixel; too small pixels are
    /// enlarged.
    DepthBuffer(double half_width, double pixel) : half_width_(half_width) {
        constexpr double most = 1024;
        const double wanted = pixel > 0.0 ? std::ceil(2.0 * half_width / pixel) : 1.0;
        width_ = static_cast<std::size_t>(std::clamp(wanted, 1.0, most));
        pixel_ = 2.0 * half_width / static_cast<double>(width_);
        depth_.resize(width_ * width_);
    }

    void clear() {
        std::fill(depth_.begin(), depth_.end(), -std::numeric_limits<double>::infinity());
    }

    /// `centre` and `normal` in the viewer's coordinates: x and y across, z towards the viewer.
    void draw(const Disc& disc, const Vec3& centre, const Vec3& normal) {
        constexpr double edge_on = 0.05;  // such a disc hides almost nothing, and its depth in a
                                          // pixel is inaccurate
        if (std::abs(normal.z()) < edge_on) return;
        const std::size_t x_end = past(centre.x() + disc.radius),
                          y_end = past(centre.y() + disc.radius);
        for (std::size_t j = pixel_of(centre.y() - disc.radius); j < y_end; ++j) {
            const double y = middle(j) - centre.y();
            for (std::size_t i = pixel_of(centre.x() - disc.radius); i < x_end; ++i) {
                const double x = middle(i) - centre.x();
                const double z = -(normal.x() * x + normal.y() * y) / normal.z();
                if (x * x + y * y + z * z > disc.radius * disc.radius) continue;
                double& depth = depth_[j * width_ + i];
                depth = std::max(depth, centre.z() + z - disc.margin);
            }
        }
    }

    bool seen(const Vec3& point) const {
        return point.z() >= depth_[pixel_of(point.y()) * width_ + pixel_of(point.x())];
    }

private:
    std::size_t pixel_of(double at) const {
        const double index = std::floor((at + half_width_) / pixel_);
        return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(width_ - 1)));
    }
    std::size_t past(double at) const { return pixel_of(at) + 1; }
    double middle(std::size_t pixel) const {
        return (static_cast<double>(pixel) + 0.5) * pixel_ - half_width_;
    }

    double half_width_, pixel_ = 0.0;
    std::size_t width_ = 0;
    std::vector<double> depth_;
};

/// Number of views that see each point.
std::vector<std::size_t> count_views(const std::vector<Disc>& discs, std::size_t views,
                                     const CancelToken* cancel) {
    std::vector<std::size_t> counts(discs.size(), 0);
    double half_width = 0.0;
    for (const Disc& disc : discs) half_width = std::max(half_width, disc.centre.norm());
    if (!(half_width > 0.0))
        return std::vector<std::size_t>(discs.size(), views);  // all points are in one place
    DepthBuffer buffer(half_width, 0.25 * median_radius(discs));
    std::vector<Vec3> centres(discs.size());
    for (std::size_t view = 0; view < views; ++view) {
        if (cancel != nullptr && cancel->cancelled())
            throw CancelledError("the run was stopped while it filtered its input");
        const Eigen::Matrix3d to_viewer =
            Eigen::Quaterniond::FromTwoVectors(direction(view, views), Vec3::UnitZ())
                .toRotationMatrix();
        buffer.clear();
        for (std::size_t i = 0; i < discs.size(); ++i) {
            centres[i] = to_viewer * discs[i].centre;
            buffer.draw(discs[i], centres[i], to_viewer * discs[i].normal);
        }
        for (std::size_t i = 0; i < discs.size(); ++i) counts[i] += buffer.seen(centres[i]) ? 1 : 0;
    }
    return counts;
}

}  // namespace

Filtered remove_hidden(const Cloud& cloud, const HiddenOptions& options,
                       const CancelToken* cancel) {
    const std::string filter = "hidden";
    const Box3 box = checked_box(cloud, filter);
    require_option(options.views >= 1 && options.views <= 10000, cloud, filter,
                   fmt::format("views is {}", options.views), "it must lie in [1, 10000]");
    require_option(options.radius > 0.0 && options.radius <= 10.0, cloud, filter,
                   "radius is " + text::rounded(options.radius),
                   "it must be above 0 and at most 10");
    require_option(options.depth > 0.0 && options.depth <= 10.0, cloud, filter,
                   "depth is " + text::rounded(options.depth), "it must be above 0 and at most 10");
    require_option(options.share >= 0.0 && options.share < 1.0, cloud, filter,
                   "share is " + text::rounded(options.share), "it must be at least 0 and below 1");
    const std::vector<std::size_t> counts =
        count_views(discs_of(cloud, box.centre(), options), options.views, cancel);
    const double bound = options.share * static_cast<double>(options.views);
    std::vector<bool> keep(counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
        keep[i] = static_cast<double>(counts[i]) > bound;
    return take(cloud, filter, keep);
}

}  // namespace dsc::cloud
