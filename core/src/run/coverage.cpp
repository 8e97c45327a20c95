// Measures how well a surface and its points agree.
#include "dsc/run/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <dsc/base/median.hpp>
#include <dsc/base/union_find.hpp>
#include <dsc/cloud/search.hpp>
#include <dsc/hooks/support.hpp>
#include <dsc/surface/distance.hpp>
#include <dsc/surface/measure.hpp>

namespace dsc::run {
namespace {

constexpr double far_noise = 3.0;   // noise scales
constexpr double far_width = 1.0;   // spacings
constexpr double group_cell = 3.0;  // median spacings: points in neighbouring cells belong to the
                                    // same group
constexpr double widest = 2.0;      // median spacings: larger spacings of a point count as this

/// Pieces of a set of points: two points are joined if the cells of a grid that contain them touch.
class Pieces {
public:
    Pieces(std::span<const Vec3> points, double cell) : cells_(points.size()) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Cell at = {index(points[i].x() / cell), index(points[i].y() / cell),
                             index(points[i].z() / cell)};
            cells_[i] =
                static_cast<std::uint32_t>(numbers_.try_emplace(at, numbers_.size()).first->second);
        }
        sets_ = UnionFind(numbers_.size());
        for (const auto& [at, number] : numbers_) join_neighbours(at, number);
    }

    /// The least cell number of the piece that contains a point.
    std::uint32_t of(std::size_t point) { return sets_.find(cells_[point]); }

private:
    using Cell = std::array<std::int64_t, 3>;

    static std::int64_t index(double coordinate) {
        return static_cast<std::int64_t>(std::floor(coordinate));
    }

    void join_neighbours(const Cell& at, std::size_t number) {
        for (std::int64_t x = -1; x <= 1; ++x)
            for (std::int64_t y = -1; y <= 1; ++y)
                for (std::int64_t z = -1; z <= 1; ++z) {
                    const auto near = numbers_.find({at[0] + x, at[1] + y, at[2] + z});
                    if (near != numbers_.end())
                        sets_.join(static_cast<std::uint32_t>(number),
                                   static_cast<std::uint32_t>(near->second));
                }
    }

    std::map<Cell, std::size_t> numbers_;
    std::vector<std::uint32_t> cells_;
    UnionFind sets_{0};
};

struct FarPoint {
    Vec3 place;
    double distance;
};

std::vector<PointGroup> groups_of(const std::vector<FarPoint>& far, double width,
                                  Workers* workers) {
    if (far.empty() || !(width > 0.0)) return {};
    std::vector<Vec3> places;
    for (const FarPoint& p : far) places.push_back(p.place);
    const std::vector<double> nearest =
        cloud::distances_to_nearest(cloud::NearestSearch(places), workers);
    Pieces pieces(places, group_cell * width);
    std::map<std::uint32_t, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < far.size(); ++i) members[pieces.of(i)].push_back(i);
    std::vector<PointGroup> groups;
    for (const auto& [piece, points] : members) {
        PointGroup& group = groups.emplace_back();
        Box3 box;
        std::vector<double> apart;
        for (const std::size_t i : points) {
            apart.push_back(nearest[i]);
            box.extend(far[i].place);
            group.centre += far[i].place / static_cast<double>(points.size());
            group.farthest = std::max(group.farthest, far[i].distance);
        }
        group.points = points.size();
        group.diameter = box.diagonal();
        group.spacing = median_of(std::move(apart));
    }
    std::stable_sort(groups.begin(), groups.end(),
                     [](const PointGroup& a, const PointGroup& b) { return a.points > b.points; });
    return groups;
}

/// Areas and gaps of the surface.
void measure_support(const surface::TriangleMesh& surface, const surface::CloudDistances& distances,
                     std::span<const double> widths, Coverage& out) {
    out.gaps.assign(surface.points.size(), 0.0);
    for (std::size_t i = 0; i < distances.vertices.size(); ++i) {
        const surface::NearestHit& hit = distances.of_vertices[i];
        if (widths[hit.index] > 0.0)
            out.gaps[distances.vertices[i]] = hit.distance / widths[hit.index];
    }
    double area = 0.0, unsupported = 0.0;
    for (const auto& face : surface.faces) {
        const Vec3 &a = surface.points[face[0]], &b = surface.points[face[1]],
                   &c = surface.points[face[2]];
        const double third = (b - a).cross(c - a).norm() / 6.0;
        for (const std::uint32_t v : face)
            unsupported += out.gaps[v] > hooks::support_reach ? third : 0.0;
        area += 3.0 * third;
    }
    out.unsupported_share = area > 0.0 ? unsupported / area : 0.0;
    out.mean_edge = surface::mean_edge(surface.points, surface.faces);
}

}  // namespace

Coverage measure_coverage(const surface::TriangleMesh& surface, std::span<const Vec3> points,
                          const surface::CloudDistances& distances,
                          const cloud::Statistics& statistics, std::span<const Vec3> removed,
                          Workers* workers) {
    Coverage out;
    out.points = points.size();
    out.width = statistics.width;
    out.noise = statistics.noise;
    measure_support(surface, distances, statistics.point_width, out);
    std::vector<FarPoint> far;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double distance = distances.of_points[i].distance;
        if (distance > out.largest_distance) {
            out.largest_distance = distance;
            out.farthest_point = points[i];
        }
        const double spacing = std::min(statistics.point_width[i], widest * statistics.width);
        if (distance > far_noise * statistics.noise + far_width * spacing)
            far.push_back({points[i], distance});
    }
    out.far_points = far.size();
    if (!removed.empty()) {
        const surface::TriangleTree tree(surface);
        std::vector<double> away(removed.size());
        for_blocks(workers, removed.size(), 1024, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) away[i] = tree.nearest(removed[i]).distance;
        });
        for (std::size_t i = 0; i < removed.size(); ++i) {
            if (away[i] > far_noise * statistics.noise + far_width * statistics.width)
                far.push_back({removed[i], away[i]});
        }
    }
    out.groups = groups_of(far, statistics.width, workers);
    return out;
}

}  // namespace dsc::run
