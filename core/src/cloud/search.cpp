// NearestSearch on FLANN, the kd-tree behind PCL's search. It is a template and works on doubles, so nothing
// is rounded; our result sets give it the order by distance and index that its own do not keep.
#include <dsc/cloud/search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <flann/general.h>
#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <dsc/base/error.hpp>

namespace dsc::cloud {

namespace {

using Metric = flann::L2_Simple<double>;
using Index = flann::KDTreeSingleIndex<Metric>;

/// The tree drops what is not nearer than this. A little more than the squared distance itself: points just
/// as far must still be seen for their index, and the tree's running sums of squares may be off by a few
/// roundings.
double widened(double squared) { return squared * (1.0 + 1e-9) + std::numeric_limits<double>::min(); }

bool before(const Neighbour& a, const Neighbour& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.index < b.index);
}

/// Keeps the best one. `distance` holds squares while the tree is walked, in all three sets.
class Best final : public flann::ResultSet<double> {
public:
    bool full() const override { return true; }
    void addPoint(double squared, std::size_t index) override {
        const Neighbour found{static_cast<std::uint32_t>(index), squared};
        if (!before(found, best)) return;
        best = found;
        worst_ = widened(squared);
    }
    double worstDist() const override { return worst_; }

    Neighbour best{std::numeric_limits<std::uint32_t>::max(), std::numeric_limits<double>::infinity()};

private:
    double worst_ = std::numeric_limits<double>::infinity();
};

/// Keeps the best k, in order.
class BestK final : public flann::ResultSet<double> {
public:
    BestK(std::size_t k, std::vector<Neighbour>& out) : k_(k), out_(out) {}
    bool full() const override { return out_.size() == k_; }
    void addPoint(double squared, std::size_t index) override {
        const Neighbour found{static_cast<std::uint32_t>(index), squared};
        if (full()) {
            if (!before(found, out_.back())) return;
            out_.pop_back();
        }
        out_.insert(std::upper_bound(out_.begin(), out_.end(), found, before), found);
        if (full()) worst_ = widened(out_.back().distance);
    }
    double worstDist() const override { return worst_; }

private:
    std::size_t k_;
    std::vector<Neighbour>& out_;
    double worst_ = std::numeric_limits<double>::infinity();
};

/// Keeps all within a radius; with `one`, stops at the first.
class Within final : public flann::ResultSet<double> {
public:
    Within(double radius, std::vector<Neighbour>* out)
        : radius_(radius), out_(out), worst_(widened(radius * radius)) {}
    bool full() const override { return true; }
    void addPoint(double squared, std::size_t index) override {
        if (!(std::sqrt(squared) <= radius_)) return;
        any = true;
        if (out_)
            out_->push_back({static_cast<std::uint32_t>(index), squared});
        else
            worst_ = -1.0;
    }
    double worstDist() const override { return worst_; }

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
        : points(source.begin(), source.end()),
          index(flann::Matrix<double>(points.data()->data(), points.size(), 3),
                flann::KDTreeSingleIndexParams(8, true)) {
        index.buildIndex();
    }
    void walk(const Vec3& p, flann::ResultSet<double>& result) const {
        index.findNeighbors(result, p.data(), exact);
    }

    std::vector<Vec3> points;
    Index index;
    flann::SearchParams exact{flann::FLANN_CHECKS_UNLIMITED, 0.0F};
};

NearestSearch::NearestSearch(std::span<const Vec3> points) {
    if (points.empty())
        throw GeometryError("cloud.empty", "nearest-point search: no points; a search needs at least one");
    if (points.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw GeometryError("cloud.large",
                            "nearest-point search: " + std::to_string(points.size()) +
                                " points; at most 2147483647 are possible, thin the cloud first");
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!points[i].allFinite())
            throw GeometryError("cloud.non_finite", "nearest-point search: point " + std::to_string(i) +
                                                        " is not finite; remove it first");
    tree_ = std::make_unique<Tree>(points);
}

NearestSearch::~NearestSearch() = default;
NearestSearch::NearestSearch(NearestSearch&&) noexcept = default;
NearestSearch& NearestSearch::operator=(NearestSearch&&) noexcept = default;

std::span<const Vec3> NearestSearch::points() const noexcept { return tree_->points; }

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

void NearestSearch::neighbours_within(const Vec3& p, double radius, std::vector<Neighbour>& out) const {
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

}  // namespace dsc::cloud
