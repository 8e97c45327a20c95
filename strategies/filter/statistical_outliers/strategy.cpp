// Filter `statistical_outliers`: removes points whose neighbours are unusually far away.
//
// Let d be the mean distance of a point to its `neighbours` nearest points. A point is removed if
//
//     d > mean of d + `deviations` * standard deviation of d
//
// over all points [Rusu2008]. The algorithm is dsc::cloud::remove_statistical_outliers.
#include <dsc/base/version.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class StatisticalOutliers final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set.
    using Params = dsc::cloud::StatisticalOutliersOptions;
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.integer("neighbours", &Params::neighbours)
            .range(1, 1000, "points")
            .doc("Number of nearest points whose mean distance is used.");
        schema.real("deviations", &Params::deviations)
            .range(0, 1000, "dimensionless")
            .doc("Number of standard deviations above the mean of all points that the mean "
                 "distance of a point may have.");
    }

    StatisticalOutliers(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext&) override {
        return dsc::cloud::remove_statistical_outliers(cloud, params_);
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("statistical_outliers", DSC_VERSION, "BSD-3-Clause",
           "Filter of points far from their neighbours") {
    registrar.add<StatisticalOutliers>("statistical_outliers",
                                       "removes points whose neighbours are unusually far away");
}
