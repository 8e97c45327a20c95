#include "strategy.hpp"

namespace dsc::strategies {

void Clusters::declare(config::ParamSchema<Params>& schema) {
    schema.real("closer", &Params::closer)
        .range(0, 1)
        .open_low()
        .open_high()
        .unit("point distances")
        .doc(
            "Distance to an earlier point up to which a point is removed; 1 is the distance that the 24 nearest points would "
            "have if they were spread evenly.");
}

Clusters::Clusters(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered Clusters::apply(const cloud::Cloud& cloud, const hooks::FilterContext&) {
    return cloud::remove_clusters(cloud, params_);
}

}  // namespace dsc::strategies
