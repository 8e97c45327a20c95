#include "strategy.hpp"

namespace dsc::strategies {

void StatisticalOutliers::declare(config::ParamSchema<Params>& schema) {
    schema.integer("neighbours", &Params::neighbours)
        .range(1, 1000)
        .unit("points")
        .doc("Number of nearest points whose mean distance is used.");
    schema.real("deviations", &Params::deviations)
        .range(0, 1000)
        .unit("1")
        .doc("Number of standard deviations above the mean of all points that the mean distance of a point may have.");
}

StatisticalOutliers::StatisticalOutliers(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered StatisticalOutliers::apply(const cloud::Cloud& cloud, const hooks::FilterContext&) {
    return cloud::remove_statistical_outliers(cloud, params_);
}

}  // namespace dsc::strategies
