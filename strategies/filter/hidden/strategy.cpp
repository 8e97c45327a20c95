#include "strategy.hpp"

namespace dsc::strategies {

void Hidden::declare(config::ParamSchema<Params>& schema) {
    schema.integer("views", &Params::views)
        .range(1, 10000)
        .unit("directions")
        .doc("Number of view directions on all sides of the cloud.");
    schema.real("radius", &Params::radius)
        .range(0, 10)
        .open_low()
        .unit("point spacings")
        .doc("Radius of the disc that represents the surface around a point.");
    schema.real("depth", &Params::depth)
        .range(0, 10)
        .open_low()
        .unit("point spacings")
        .doc("Distance behind a disc from which the disc hides a point.");
    schema.real("share", &Params::share)
        .range(0, 1)
        .open_high()
        .unit("1")
        .doc("Fraction of the views; a point that this fraction of the views or fewer see is removed.");
}

Hidden::Hidden(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered Hidden::apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) {
    return cloud::remove_hidden(cloud, params_, context.cancel);
}

}  // namespace dsc::strategies
