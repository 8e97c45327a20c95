// Flags strewn points, points off the surface, and clumps.
#include "stray.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>

namespace dsc::cloud {

namespace {

// Uniform points in a ball have a roundness of 0.3, points of a very noisy surface 0.1; at creases
// single points reach 0.3.
constexpr double round_enough = 0.22;
constexpr double clump_roundness = 0.2;
constexpr double clump_share = 0.02;   // largest clump, as a fraction of all points
constexpr std::size_t few_points = 8;  // a group of so few points is not part of a surface

constexpr double closer = 1.3;  // a neighbour that is this many times closer shows the surface
constexpr std::size_t least_closer = 6;  // least number of such neighbours, for a plane
constexpr double least_reach = 1.3;      // of a point off the surface: in reaches of most points,
constexpr double reach_beside = 1.6;     // and in reaches of those neighbours
constexpr double height = 0.5;           // its distance from their plane, in its own reach,
constexpr double height_in_noise = 4.0;  // and in root mean square distances of those neighbours

constexpr std::size_t stray_block = 256;

using Near = std::array<Vec3, remaining_neighbours + 1>;

/// Spread of the first `count` points about their mean.
Eigen::Matrix3d spread_of(const Near& near, std::size_t count, Vec3& mean) {
    mean.setZero();
    for (std::size_t n = 0; n < count; ++n) mean += near[n];
    mean /= static_cast<double>(count);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (std::size_t n = 0; n < count; ++n)
        spread += (near[n] - mean) * (near[n] - mean).transpose();
    return spread;
}

/// Smallest over largest spread of points and their neighbours, computed on demand.
class Roundness {
public:
    Roundness(const Remaining& cloud, Workers* workers)
        : cloud_(cloud), workers_(workers), value_(cloud.points().size(), unknown) {}

    /// Computes the roundness of these points and, with `around`, of their neighbours.
    void find(const std::vector<std::uint32_t>& points, bool around) {
        std::vector<std::uint32_t> wanted;
        const auto want = [&](std::uint32_t i) {
            if (value_[i] != unknown) return;
            value_[i] = 0.0;
            wanted.push_back(i);
        };
        for (const std::uint32_t i : points) {
            want(i);
            if (!around) continue;
            for (const std::uint32_t j : cloud_.neighbours().of(i)) want(j);
        }
        for_blocks(workers_, wanted.size(), stray_block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) value_[wanted[n]] = at(wanted[n]);
        });
    }

    double operator[](std::size_t i) const { return value_[i]; }

    /// Mean of a point and its neighbours.
    double around(std::size_t i) const {
        const auto others = cloud_.neighbours().of(i);
        double sum = value_[i];
        for (const std::uint32_t j : others) sum += value_[j];
        return sum / static_cast<double>(others.size() + 1);
    }

private:
    static constexpr double unknown = -1.0;

    double at(std::size_t i) const {
        const auto points = cloud_.points();
        const auto others = cloud_.neighbours().of(i);
        Near near{};
        near[0].setZero();
        for (std::size_t n = 0; n < others.size(); ++n) near[n + 1] = points[others[n]] - points[i];
        Vec3 mean;
        const Eigen::Matrix3d spread = spread_of(near, others.size() + 1, mean);
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
        const Vec3 least_first = solver.computeDirect(spread, Eigen::EigenvaluesOnly).eigenvalues();
        return least_first[2] > 0.0 ? std::max(0.0, least_first[0] / least_first[2]) : 0.0;
    }

    const Remaining& cloud_;
    Workers* workers_;
    std::vector<double> value_;
};

/// Indices of the remaining points that are farther apart than this.
std::vector<std::uint32_t> apart(const Remaining& cloud, double reach) {
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i < cloud.points().size(); ++i)
        if (cloud.has(i) && cloud.neighbours().reach[i] > reach)
            out.push_back(static_cast<std::uint32_t>(i));
    return out;
}

bool lies_off_surface(const Remaining& cloud, std::size_t i) {
    const Neighbours& neighbours = cloud.neighbours();
    const double reach = neighbours.reach[i];
    Near near{};
    std::array<double, remaining_neighbours> reaches{};
    std::size_t count = 0;
    for (const std::uint32_t j : neighbours.of(i)) {
        if (closer * neighbours.reach[j] >= reach) continue;
        near[count] = cloud.points()[j] - cloud.points()[i];
        reaches[count++] = neighbours.reach[j];
    }
    if (count < least_closer) return false;
    const auto middle = reaches.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(reaches.begin(), middle, reaches.begin() + static_cast<std::ptrdiff_t>(count));
    if (reach <= reach_beside * *middle) return false;
    Vec3 mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread_of(near, count, mean));
    const double off = std::abs(mean.dot(axes.eigenvectors().col(0)));
    const double noise =
        std::sqrt(std::max(0.0, axes.eigenvalues()[0]) / static_cast<double>(count - 3));
    return off > height * reach && off > height_in_noise * noise;
}

/// Groups of points that are mutual neighbours; each point refers to the first point of its group.
class Groups {
public:
    explicit Groups(const Remaining& cloud) : first_(cloud.points().size()) {
        std::iota(first_.begin(), first_.end(), 0U);
        const Neighbours& neighbours = cloud.neighbours();
        const auto nearest = [&](std::uint32_t i) {
            return neighbours.of(i).first(neighbours.reached());
        };
        for (std::uint32_t i = 0; i < first_.size(); ++i) {
            if (!cloud.has(i)) continue;
            for (const std::uint32_t j : nearest(i)) {
                const auto back = nearest(j);
                if (i < j && std::find(back.begin(), back.end(), i) != back.end()) join(i, j);
            }
        }
    }

    std::uint32_t of(std::uint32_t i) {
        while (first_[i] != i) i = first_[i] = first_[first_[i]];
        return i;
    }

private:
    void join(std::uint32_t i, std::uint32_t j) {
        i = of(i);
        j = of(j);
        first_[std::max(i, j)] = std::min(i, j);
    }

    std::vector<std::uint32_t> first_;
};

}  // namespace

Flags strewn_points(const Remaining& cloud, double factor, Workers* workers) {
    Flags out(cloud.points().size(), 0);
    std::vector<std::uint32_t> candidates = apart(cloud, factor * cloud.median_reach());
    Roundness roundness(cloud, workers);
    roundness.find(candidates, true);
    const auto flat = [&](std::uint32_t i) { return roundness.around(i) <= round_enough; };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), flat), candidates.end());
    std::vector<std::uint32_t> around;
    for (const std::uint32_t i : candidates)
        for (const std::uint32_t j : cloud.neighbours().of(i)) around.push_back(j);
    roundness.find(around, true);
    for (const std::uint32_t i : candidates) {
        double sum = roundness.around(i);
        for (const std::uint32_t j : cloud.neighbours().of(i)) sum += roundness.around(j);
        out[i] = sum > round_enough * static_cast<double>(cloud.neighbours().each + 1);
    }
    return out;
}

Flags off_surface_points(const Remaining& cloud, Workers* workers) {
    Flags out(cloud.points().size(), 0);
    const std::vector<std::uint32_t> candidates = apart(cloud, least_reach * cloud.median_reach());
    for_blocks(workers, candidates.size(), stray_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n)
            out[candidates[n]] = lies_off_surface(cloud, candidates[n]);
    });
    return out;
}

Flags clumps(const Remaining& cloud, Workers* workers) {
    const std::size_t count = cloud.points().size();
    Groups groups(cloud);
    std::vector<std::uint32_t> members(count, 0);
    for (std::uint32_t i = 0; i < count; ++i)
        if (cloud.has(i)) ++members[groups.of(i)];
    const double largest = clump_share * static_cast<double>(cloud.count());
    std::vector<std::uint32_t> in_small;
    for (std::uint32_t i = 0; i < count; ++i)
        if (cloud.has(i) && static_cast<double>(members[groups.of(i)]) <= largest)
            in_small.push_back(i);
    Roundness roundness(cloud, workers);
    roundness.find(in_small, false);
    std::vector<double> sum(count, 0.0);
    for (const std::uint32_t i : in_small) sum[groups.of(i)] += roundness[i];
    Flags out(count, 0);
    for (const std::uint32_t i : in_small) {
        const std::uint32_t group = groups.of(i);
        out[i] = members[group] <= few_points || sum[group] > clump_roundness * members[group];
    }
    return out;
}

}  // namespace dsc::cloud
