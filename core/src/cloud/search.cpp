// NearestSearch with nanoflann's kd-tree. The tree is a template and works on doubles, so nothing
// is rounded, and a query allocates nothing. The result sets here add the order by distance and
// index, which nanoflann's own sets do not keep.
#include "dsc/cloud/search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nanoflann.hpp>

#include <dsc/base/error.hpp>

#include "checks.hpp"

namespace dsc::cloud {

namespace {

/// The points in the form that the tree reads.
struct Points {
    std::vector<Vec3> points;

    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t index, std::size_t axis) const {
        return points[index][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};
using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>,
                                                  Points, 3, std::uint32_t>;

/// The tree drops points that are not nearer than this. It is slightly more than the squared
/// distance: points at the same distance must still be compared by index, and the tree's running
/// sums of squares may be off by a few roundings.
double widened(double squared) {
    return squared * (1.0 + 1e-9) + std::numeric_limits<double>::min();
}

bool before(const Neighbour& a, const Neighbour& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.index < b.index);
}

/// Keeps the best point. In all three sets, `distance` contains squares during the search.
class Best {
public:
    using DistanceType = double;
    using IndexType = std::uint32_t;
    bool full() const { return true; }
    bool addPoint(double squared, std::uint32_t index) {
        const Neighbour found{index, squared};
        if (before(found, best)) {
            best = found;
            worst_ = widened(squared);
        }
        return true;
    }
    double worstDist() const { return worst_; }

    Neighbour best{std::numeric_limits<std::uint32_t>::max(),
                   std::numeric_limits<double>::infinity()};

private:
    double worst_ = std::numeric_limits<double>::infinity();
};

/// Keeps the best k, in order.
class BestK {
public:
    using DistanceType = double;
    using IndexType = std::uint32_t;
    BestK(std::size_t k, std::vector<Neighbour>& out) : k_(k), out_(out) {}
    bool full() const { return out_.size() == k_; }
    bool addPoint(double squared, std::uint32_t index) {
        const Neighbour found{index, squared};
        if (full()) {
            if (!before(found, out_.back())) return true;
            out_.pop_back();
        }
        out_.insert(std::upper_bound(out_.begin(), out_.end(), found, before), found);
        if (full()) worst_ = widened(out_.back().distance);
        return true;
    }
    double worstDist() const { return worst_; }

private:
    std::size_t k_;
    std::vector<Neighbour>& out_;
    double worst_ = std::numeric_limits<double>::infinity();
};

/// Keeps all within a radius; with `one`, stops at the first.
class Within {
public:
    using DistanceType = double;
    using IndexType = std::uint32_t;
    Within(double radius, std::vector<Neighbour>* out)
        : radius_(radius), out_(out), worst_(widened(radius * radius)) {}
    bool full() const { return true; }
    bool addPoint(double squared, std::uint32_t index) {
        if (!(std::sqrt(squared) <= radius_)) return true;
        any = true;
        if (out_) out_->push_back({index, squared});
        return out_ != nullptr;  // one point is enough if the caller does not want all of them
    }
    double worstDist() const { return worst_; }

    bool any = false;

private:
    double radius_;
    std::vector<Neighbour>* out_;
    double worst_;
};

void take_roots(std::vector<Neighbour>& out) {
    for (Neighbour& n : out) n.distance = std::sqrt(n.distance);
}

}  // namespace

struct NearestSearch::Tree {
    explicit Tree(std::span<const Vec3> source)
        : points{{source.begin(), source.end()}},
          index(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(8)) {
        index.buildIndex();
    }
    template <class Result>
    void walk(const Vec3& p, Result& result) const {
        index.findNeighbors(result, p.data(), nanoflann::SearchParams());
    }

    Points points;
    Index index;
};

NearestSearch::NearestSearch(std::span<const Vec3> points) {
    if (points.empty())
        throw GeometryError("cloud.empty", "nearest-point search", "no points",
                            "a search needs at least one");
    require_searchable(points, "nearest-point search");
    tree_ = std::make_unique<Tree>(points);
}

NearestSearch::~NearestSearch() = default;
NearestSearch::NearestSearch(NearestSearch&&) noexcept = default;
NearestSearch& NearestSearch::operator=(NearestSearch&&) noexcept = default;

std::span<const Vec3> NearestSearch::points() const noexcept { return tree_->points.points; }

Neighbour NearestSearch::nearest(const Vec3& p) const {
    Best result;
    tree_->walk(p, result);
    return {result.best.index, std::sqrt(result.best.distance)};
}

void NearestSearch::k_nearest(const Vec3& p, std::size_t k, std::vector<Neighbour>& out) const {
    out.clear();
    if (k == 0) return;
    BestK result(k, out);
    tree_->walk(p, result);
    take_roots(out);
}

void NearestSearch::neighbours_within(const Vec3& p, double radius,
                                      std::vector<Neighbour>& out) const {
    out.clear();
    if (!(radius >= 0.0)) return;
    Within result(radius, &out);
    tree_->walk(p, result);
    std::sort(out.begin(), out.end(), before);
    take_roots(out);
}

bool NearestSearch::within(const Vec3& p, double radius) const {
    if (!(radius >= 0.0)) return false;
    Within result(radius, nullptr);
    tree_->walk(p, result);
    return result.any;
}

std::vector<double> distances_to_nearest(const NearestSearch& search, Workers* workers) {
    const std::span<const Vec3> points = search.points();
    std::vector<double> out(points.size(), 0.0);
    if (points.size() < 2) return out;
    for_blocks(workers, points.size(), 1024, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbour> two;
        for (std::size_t i = begin; i < end; ++i) {
            search.k_nearest(points[i], 2, two);
            out[i] = two[1].distance;
        }
    });
    return out;
}

}  // namespace dsc::cloud
