#include "strategy.hpp"

namespace dsc::strategies {

void RadiusOutliers::declare(config::ParamSchema<Params>& schema) {
    schema.real("radius", &Params::radius)
        .range(0, 1)
        .open_low()
        .unit("diagonals")
        .doc("Radius within which neighbours are counted.");
    schema.integer("neighbours", &Params::neighbours)
        .range(1, 1000)
        .unit("points")
        .doc("Number of neighbours below which a point is removed.");
}

RadiusOutliers::RadiusOutliers(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered RadiusOutliers::apply(const cloud::Cloud& cloud, const hooks::FilterContext&) {
    return cloud::remove_radius_outliers(cloud, params_);
}

}  // namespace dsc::strategies
