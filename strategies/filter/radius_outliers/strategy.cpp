// Filter `radius_outliers`: removes points with few neighbours.
//
// A point is removed if fewer than `neighbours` other points lie within `radius`. The algorithm is
// dsc::cloud::remove_radius_outliers.
#include <dsc/base/version.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class RadiusOutliers final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set.
    using Params = dsc::cloud::RadiusOutliersOptions;
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("radius", &Params::radius)
            .range(0, 1, "diagonals")
            .open_low()
            .doc("Radius within which neighbours are counted.");
        schema.integer("neighbours", &Params::neighbours)
            .range(1, 1000, "points")
            .doc("Number of neighbours below which a point is removed.");
    }

    RadiusOutliers(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext&) override {
        return dsc::cloud::remove_radius_outliers(cloud, params_);
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("radius_outliers", DSC_VERSION, "BSD-3-Clause", "Filter of isolated points") {
    registrar.add<RadiusOutliers>("radius_outliers", "removes points with few neighbours");
}
