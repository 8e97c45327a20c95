#include <dsc/cloud/filter.hpp>

#include <algorithm>
#include <cmath>

#include "filtering.hpp"
#include "neighbours.hpp"
#include "text.hpp"

namespace dsc::cloud {

namespace {

void require_factor(double value, const char* option, const Cloud& cloud, const std::string& filter) {
    require_option(value > 1.0 && std::isfinite(value), cloud, filter,
                   std::string(option) + " is " + short_number(value) + "; it must be above 1");
}

}  // namespace

Filtered remove_outliers(const Cloud& cloud, const OutliersOptions& options, Workers* workers) {
    const std::string filter = "outliers";
    checked_box(cloud, filter);
    require_factor(options.isolated, "isolated", cloud, filter);
    require_factor(options.far, "far", cloud, filter);
    require_option(options.most >= 0.0 && options.most < 1.0, cloud, filter,
                   "most is " + short_number(options.most) + "; it must be at least 0 and below 1");
    const std::size_t count = cloud.points.size();
    std::vector<bool> keep(count, true);
    RemovedPoints isolated{"isolated", 0}, far{"far", 0};
    if (count > 1) {
        const Neighbours neighbours = find_neighbours(cloud.points, reach_neighbours, workers);
        const std::vector<double> around = median_reaches(neighbours, workers);
        const double median = median_of(neighbours.reach);
        for (std::size_t i = 0; i < count; ++i) {
            const double reach = neighbours.reach[i];
            const bool alone = reach > options.isolated * around[i] && reach > options.isolated * median;
            const bool apart = reach > options.far * median;
            keep[i] = !alone && !apart;
            if (alone)
                ++isolated.count;
            else if (apart)
                ++far.count;
        }
        const std::size_t removed = isolated.count + far.count;
        if (median == 0.0 || static_cast<double>(removed) > options.most * static_cast<double>(count)) {
            keep.assign(count, true);
            isolated.count = far.count = 0;
        }
    }
    Filtered result = take(cloud, filter, keep);
    result.report.reasons = {isolated, far};
    return result;
}

}  // namespace dsc::cloud
