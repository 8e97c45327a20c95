#pragma once
// Filter `outliers`: removes points far from all others.

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// cloud::remove_outliers as a filter of experiments.
class Outliers final : public hooks::CloudFilter {
public:
    using Params = cloud::OutliersOptions;
    static void declare(config::ParamSchema<Params>& schema);

    Outliers(const Params& params, const plugin::Setup& setup);

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
