// Filter `clusters`: removes points where many lie close together.
//
// A point is removed if its distance to an earlier point that stays is at most `closer` times d.
// The length d is the distance that the 24 nearest points would have if they were spread evenly
// over a flat piece of surface. The algorithm is dsc::cloud::remove_clusters.
#include <dsc/base/version.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class Clusters final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set.
    using Params = dsc::cloud::ClustersOptions;
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("closer", &Params::closer)
            .range(0, 1, "point distances")
            .open_low()
            .open_high()
            .doc("Distance to an earlier point up to which a point is removed; 1 is the distance "
                 "that the 24 nearest points would have if they were spread evenly.");
    }

    Clusters(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext&) override {
        return dsc::cloud::remove_clusters(cloud, params_);
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("clusters", DSC_VERSION, "BSD-3-Clause", "Filter that thins crowded points") {
    registrar.add<Clusters>("clusters", "removes points where many lie close together");
}
