#pragma once
// Filter `statistical_outliers`: removes points whose neighbours are unusually far away.

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// cloud::remove_statistical_outliers as a filter of experiments.
class StatisticalOutliers final : public hooks::CloudFilter {
public:
    using Params = cloud::StatisticalOutliersOptions;
    static void declare(config::ParamSchema<Params>& schema);

    StatisticalOutliers(const Params& params, const plugin::Setup& setup);

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
