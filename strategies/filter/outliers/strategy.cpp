#include "strategy.hpp"

namespace dsc::strategies {

void Outliers::declare(config::ParamSchema<Params>& schema) {
    schema.real("isolated", &Params::isolated)
        .range(1.01, 1000)
        .unit("1")
        .doc("Factor above which a point is isolated: its distance to its 8th neighbour over that of its neighbours, and over "
             "that of most points.");
    schema.real("far", &Params::far)
        .range(1.01, 1e6)
        .unit("1")
        .doc("Largest allowed factor between the distance of a point to its 8th neighbour and that of most points.");
    schema.real("most", &Params::most)
        .range(0, 0.99)
        .unit("1")
        .doc("Fraction of the points; if more than this would be removed, none is removed.");
    schema.real("dirty", &Params::dirty)
        .range(0, 1)
        .unit("1")
        .doc("Fraction of isolated points above which all points are searched in rounds for outliers among outliers.");
}

Outliers::Outliers(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered Outliers::apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) {
    return cloud::remove_outliers(cloud, params_, context.workers);
}

}  // namespace dsc::strategies
