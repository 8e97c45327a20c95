// Filter `hidden`: removes points that no view from outside can see.
//
// Each point represents a disc. From each of many directions the discs are drawn into a depth
// buffer, as in visibility splatting [Pfister2000]; a disc hides the points that lie farther than
// `depth` behind it. A point is removed if at most the fraction `share` of the views can see it.
// The algorithm is dsc::cloud::remove_hidden.
#include <dsc/base/version.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class Hidden final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set.
    using Params = dsc::cloud::HiddenOptions;
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.integer("views", &Params::views)
            .range(1, 10000, "directions")
            .doc("Number of view directions on all sides of the cloud.");
        schema.real("radius", &Params::radius)
            .range(0, 10, "neighbour distances")
            .open_low()
            .doc("Radius of the disc that represents the surface around a point.");
        schema.real("depth", &Params::depth)
            .range(0, 10, "neighbour distances")
            .open_low()
            .doc("Distance behind a disc from which the disc hides a point.");
        schema.real("share", &Params::share)
            .range(0, 1, "dimensionless")
            .open_high()
            .doc("Fraction of the views; a point that this fraction of the views or fewer see is "
                 "removed.");
    }

    Hidden(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext& context) override {
        return dsc::cloud::remove_hidden(cloud, params_, context.cancel);
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("hidden", DSC_VERSION, "BSD-3-Clause", "Filter that removes points inside the object") {
    registrar.add<Hidden>("hidden", "removes points that no view from outside can see");
}
