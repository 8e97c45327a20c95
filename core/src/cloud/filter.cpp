// The simple filters: duplicates, clusters, grid, statistics and radius.
#include "dsc/cloud/filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>

#include <fmt/core.h>

#include <dsc/cloud/search.hpp>
#include <dsc/text/numbers.hpp>

#include "filtering.hpp"
#include "order.hpp"
#include "pcl_backend.hpp"

namespace dsc::cloud {

namespace {

/// The points moved to the origin and scaled to a diagonal of 1, for PCL's floats. All zero if all
/// points are equal.
std::vector<Vec3> recentred(const Cloud& cloud, const Box3& box) {
    const double diagonal = box.diagonal();
    std::vector<Vec3> points;
    points.reserve(cloud.points.size());
    for (const Vec3& p : cloud.points)
        points.push_back(diagonal > 0.0 ? Vec3((p - box.centre()) / diagonal) : Vec3::Zero());
    return points;
}

void mark_exact_duplicates(const std::vector<Vec3>& points, std::vector<bool>& keep) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto key = [&](std::size_t i) {
        return std::make_tuple(points[i].x(), points[i].y(), points[i].z());
    };
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        const auto a = key(i), b = key(j);
        return a < b || (a == b && i < j);
    });
    for (std::size_t n = 1; n < order.size(); ++n)
        if (points[order[n]] == points[order[n - 1]]) keep[order[n]] = false;
}

/// Removes the neighbours that come after point i.
void drop_later(const std::vector<Neighbour>& neighbours, std::size_t i, std::vector<bool>& keep) {
    for (const Neighbour& n : neighbours)
        if (n.index > i) keep[n.index] = false;
}

void mark_close(const std::vector<Vec3>& points, double distance, std::vector<bool>& keep) {
    const NearestSearch search(points);
    std::vector<Neighbour> close;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!keep[i]) continue;
        search.neighbours_within(points[i], distance, close);
        drop_later(close, i, keep);
    }
}

/// False for points that repeat an earlier point or lie within the distance of an earlier point
/// that stays.
std::vector<bool> first_of_each(const std::vector<Vec3>& points, double distance) {
    std::vector<bool> keep(points.size(), true);
    mark_exact_duplicates(points, keep);
    if (distance > 0.0) mark_close(points, distance, keep);
    return keep;
}

}  // namespace

Filtered remove_duplicates(const Cloud& cloud, const DuplicatesOptions& options) {
    const std::string filter = "duplicates";
    const Box3 box = checked_box(cloud, filter);
    require_option(options.tolerance >= 0.0 && options.tolerance <= 1.0, cloud, filter,
                   "tolerance is " + text::rounded(options.tolerance), "it must lie in [0, 1]");
    if (!options.sort)
        return take(cloud, filter, first_of_each(cloud.points, options.tolerance * box.diagonal()));
    // The points are ordered before the first of each is chosen, so the choice does not depend on
    // the order of the input.
    const std::vector<std::size_t> order = lexicographic_order(cloud);
    std::vector<Vec3> points;
    points.reserve(order.size());
    for (const std::size_t i : order) points.push_back(cloud.points[i]);
    const std::vector<bool> keep = first_of_each(points, options.tolerance * box.diagonal());
    std::vector<std::size_t> kept;
    for (std::size_t n = 0; n < order.size(); ++n)
        if (keep[n]) kept.push_back(order[n]);
    return take(cloud, filter, kept);
}

// The distance that evenly spread points would have is computed from enough neighbours that a
// cluster is a small part of them: each of k points in a disc of radius r has the area pi r^2 / k.
Filtered remove_clusters(const Cloud& cloud, const ClustersOptions& options) {
    constexpr std::size_t around = 24;
    const std::string filter = "clusters";
    checked_box(cloud, filter);
    require_option(options.closer > 0.0 && options.closer < 1.0, cloud, filter,
                   "closer is " + text::rounded(options.closer), "it must lie between 0 and 1");
    const double even = std::sqrt(std::acos(-1.0) / around);
    const NearestSearch search(cloud.points);
    std::vector<bool> keep(cloud.points.size(), true);
    std::vector<Neighbour> found;
    for (std::size_t i = 0; i < keep.size(); ++i) {
        if (!keep[i]) continue;
        search.k_nearest(cloud.points[i], around + 1, found);
        if (found.size() <= around) break;  // too few points for a statement
        search.neighbours_within(cloud.points[i], options.closer * even * found.back().distance,
                                 found);
        drop_later(found, i, keep);
    }
    return take(cloud, filter, keep);
}

// Not PCL's filter of this name: that one returns averages in float, without indices, and refuses
// fine grids.
Filtered voxel_grid(const Cloud& cloud, const VoxelGridOptions& options) {
    const std::string filter = "voxel_grid";
    const Box3 box = checked_box(cloud, filter);
    require_option(options.size >= 1e-9 && options.size <= 1.0, cloud, filter,
                   "size is " + text::rounded(options.size), "it must lie in [1e-9, 1]");
    const double edge = options.size * box.diagonal();
    struct Entry {
        std::array<std::int64_t, 3> cell;
        std::size_t index;
    };
    std::vector<Entry> entries(cloud.points.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Vec3 from_low = cloud.points[i] - box.low;
        for (std::size_t k = 0; k < 3; ++k)
            entries[i].cell[k] =
                edge > 0.0
                    ? static_cast<std::int64_t>(std::floor(from_low[static_cast<int>(k)] / edge))
                    : 0;
        entries[i].index = i;
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.cell, a.index) < std::tie(b.cell, b.index);
    });

    std::vector<bool> keep(cloud.points.size(), false);
    for (std::size_t begin = 0; begin < entries.size();) {
        std::size_t end = begin;
        Vec3 sum = Vec3::Zero();  // relative to the box, so that large coordinates keep their
                                  // digits
        for (; end < entries.size() && entries[end].cell == entries[begin].cell; ++end)
            sum += cloud.points[entries[end].index] - box.low;
        const Vec3 centroid = sum / static_cast<double>(end - begin);
        std::size_t best = begin;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t n = begin; n < end; ++n) {
            const double distance =
                (cloud.points[entries[n].index] - box.low - centroid).squaredNorm();
            if (distance >= least * (1.0 - 1e-9))
                continue;  // two points always have the same distance: the first is taken, so that
                           // rounding does not decide
            least = distance;
            best = n;
        }
        keep[entries[best].index] = true;
        begin = end;
    }
    return take(cloud, filter, keep);
}

Filtered remove_statistical_outliers(const Cloud& cloud,
                                     const StatisticalOutliersOptions& options) {
    const std::string filter = "statistical_outliers";
    const Box3 box = checked_box(cloud, filter);
    require_option(options.neighbours >= 1 && options.neighbours <= 1000, cloud, filter,
                   fmt::format("neighbours is {}", options.neighbours), "it must lie in [1, 1000]");
    require_option(options.deviations >= 0.0 && std::isfinite(options.deviations), cloud, filter,
                   "deviations is " + text::rounded(options.deviations), "it must be at least 0");
    // PCL reads beyond its buffer if a cloud has no more points than requested neighbours.
    const std::size_t neighbours = std::min(options.neighbours, cloud.points.size() - 1);
    if (neighbours == 0) return take(cloud, filter, std::vector<bool>(cloud.points.size(), true));
    return take(
        cloud, filter,
        pcl_backend().statistical_inliers(recentred(cloud, box), neighbours, options.deviations));
}

Filtered remove_radius_outliers(const Cloud& cloud, const RadiusOutliersOptions& options) {
    const std::string filter = "radius_outliers";
    const Box3 box = checked_box(cloud, filter);
    require_option(options.radius > 0.0 && options.radius <= 1.0, cloud, filter,
                   "radius is " + text::rounded(options.radius),
                   "it must be above 0 and at most 1");
    require_option(options.neighbours >= 1 && options.neighbours <= 1000, cloud, filter,
                   fmt::format("neighbours is {}", options.neighbours), "it must lie in [1, 1000]");
    return take(
        cloud, filter,
        pcl_backend().radius_inliers(recentred(cloud, box), options.radius, options.neighbours));
}

}  // namespace dsc::cloud
