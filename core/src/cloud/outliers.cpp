// Removes points far from all others, in rounds if the cloud is dirty.
#include <algorithm>
#include <array>
#include <cmath>

#include <dsc/cloud/filter.hpp>
#include <dsc/text/numbers.hpp>

#include "filtering.hpp"
#include "neighbours.hpp"
#include "remaining.hpp"
#include "stray.hpp"

namespace dsc::cloud {

namespace {

constexpr double surely_apart = 2.0;   // points this many times as far apart as most points show
                                       // that a cloud is dirty
constexpr double apart_enough = 1.5;   // the same once the cloud is known to be dirty
constexpr std::size_t few_strays = 8;  // so few points do not show it
constexpr int most_rounds = 8;
constexpr double little = 0.0005;  // a round that removes this fraction of the points or less is
                                   // the last

enum Reason : unsigned char { stays, isolated, distant, strewn, off_surface, clump, reason_count };

void require_factor(double value, const char* option, const Cloud& cloud,
                    const std::string& filter) {
    require_option(value > 1.0 && std::isfinite(value), cloud, filter,
                   std::string(option) + " is " + text::rounded(value), "it must be above 1");
}

std::size_t set_in(const Flags& flags) {
    return static_cast<std::size_t>(
        std::count(flags.begin(), flags.end(), static_cast<unsigned char>(1)));
}

/// Finds the reason of every removed point, round by round.
class Cleaner {
public:
    Cleaner(std::span<const Vec3> points, const OutliersOptions& options, Workers* workers)
        : reasons(points.size(), stays),
          options_(options),
          workers_(workers),
          left_(points, workers) {}

    void clean() {
        const double median = left_.median_reach();
        if (median == 0.0) return;
        mark_apart(median);
        if (!is_dirty(median)) return;
        mark_strays();
        for (int round = 1; drop() && round < most_rounds; ++round) {
            mark_apart(left_.median_reach());
            mark_strays();
        }
        mark(clumps(left_, workers_), clump);
    }

    std::vector<unsigned char> reasons;

private:
    bool many(std::size_t points) const {
        return points > few_strays &&
               static_cast<double>(points) > options_.dirty * static_cast<double>(reasons.size());
    }

    /// Whether the marked points, together with the surely strewn ones, are more than a clean cloud
    /// has.
    bool is_dirty(double median) const {
        const std::vector<double>& reach = left_.neighbours().reach;
        const auto far_apart = [&](double r) { return r > surely_apart * median; };
        if (!many(static_cast<std::size_t>(std::count_if(reach.begin(), reach.end(), far_apart))))
            return false;
        Flags strays = strewn_points(left_, surely_apart, workers_);
        for (std::size_t i = 0; i < strays.size(); ++i)
            if (reasons[i] != stays) strays[i] = 1;
        return many(set_in(strays));
    }

    void mark(const Flags& flags, Reason reason) {
        for (std::size_t i = 0; i < flags.size(); ++i)
            if (flags[i] != 0 && reasons[i] == stays) reasons[i] = reason;
    }

    void mark_apart(double median) {
        const Neighbours& neighbours = left_.neighbours();
        const std::vector<double> around = median_reaches(neighbours, workers_);
        for (std::size_t i = 0; i < reasons.size(); ++i) {
            if (!left_.has(i)) continue;
            const double reach = neighbours.reach[i];
            if (reach > options_.isolated * around[i] && reach > options_.isolated * median)
                reasons[i] = isolated;
            else if (reach > options_.far * median)
                reasons[i] = distant;
        }
    }

    void mark_strays() {
        mark(strewn_points(left_, apart_enough, workers_), strewn);
        mark(off_surface_points(left_, workers_), off_surface);
    }

    /// Removes the points marked since the last call; returns whether another round is worthwhile.
    bool drop() {
        const std::size_t before = left_.count();
        Flags gone(reasons.size(), 0);
        std::size_t staying = 0;
        for (std::size_t i = 0; i < gone.size(); ++i) {
            gone[i] = reasons[i] != stays;
            staying += reasons[i] == stays;
        }
        if (staying <= remaining_neighbours) return false;
        left_.remove(gone, workers_);
        return static_cast<double>(before - staying) > little * static_cast<double>(before);
    }

    const OutliersOptions& options_;
    Workers* workers_;
    Remaining left_;
};

}  // namespace

Filtered remove_outliers(const Cloud& cloud, const OutliersOptions& options, Workers* workers) {
    const std::string filter = "outliers";
    checked_box(cloud, filter);
    require_factor(options.isolated, "isolated", cloud, filter);
    require_factor(options.far, "far", cloud, filter);
    require_option(options.most >= 0.0 && options.most < 1.0, cloud, filter,
                   "most is " + text::rounded(options.most), "it must be at least 0 and below 1");
    require_option(options.dirty >= 0.0 && options.dirty <= 1.0, cloud, filter,
                   "dirty is " + text::rounded(options.dirty),
                   "it must be at least 0 and at most 1");
    const std::size_t count = cloud.points.size();
    std::vector<bool> keep(count, true);
    std::array<std::size_t, reason_count> counts{};
    if (count > 1) {
        Cleaner cleaner(cloud.points, options, workers);
        cleaner.clean();
        for (const unsigned char reason : cleaner.reasons) ++counts[reason];
        if (static_cast<double>(count - counts[stays]) > options.most * static_cast<double>(count))
            counts = {};
        else
            for (std::size_t i = 0; i < count; ++i) keep[i] = cleaner.reasons[i] == stays;
    }
    Filtered result = take(cloud, filter, keep);
    result.report.reasons = {{"isolated", counts[isolated]},
                             {"far", counts[distant]},
                             {"strewn", counts[strewn]},
                             {"off_surface", counts[off_surface]},
                             {"clump", counts[clump]}};
    return result;
}

}  // namespace dsc::cloud
