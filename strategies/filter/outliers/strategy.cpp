#include "strategy.hpp"

namespace dsc::strategies {

void Outliers::declare(config::ParamSchema<Params>& schema) {
    schema.real("isolated", &Params::isolated)
        .range(1.01, 1000)
        .unit("1")
        .doc("How many times as far from its 8th neighbour as its neighbours, and as most points, an isolated point lies.");
    schema.real("far", &Params::far)
        .range(1.01, 1e6)
        .unit("1")
        .doc("How many times as far from its 8th neighbour as most points a point may lie at all.");
    schema.real("most", &Params::most)
        .range(0, 0.99)
        .unit("1")
        .doc("If more than this part of the points would go, none goes.");
    schema.real("dirty", &Params::dirty)
        .range(0, 1)
        .unit("1")
        .doc("If more than this part of the points lie apart, all are searched, round by round, for outliers among outliers.");
}

Outliers::Outliers(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered Outliers::apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) {
    return cloud::remove_outliers(cloud, params_, context.workers);
}

}  // namespace dsc::strategies
