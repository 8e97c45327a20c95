#pragma once
// Filter `radius_outliers`: removes points with few neighbours.

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// cloud::remove_radius_outliers as a filter of experiments.
class RadiusOutliers final : public hooks::CloudFilter {
public:
    using Params = cloud::RadiusOutliersOptions;
    static void declare(config::ParamSchema<Params>& schema);

    RadiusOutliers(const Params& params, const plugin::Setup& setup);

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
