#pragma once
// Filter `hidden`: removes points that no view from outside can see.

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// cloud::remove_hidden as a filter of experiments.
class Hidden final : public hooks::CloudFilter {
public:
    using Params = cloud::HiddenOptions;
    static void declare(config::ParamSchema<Params>& schema);

    Hidden(const Params& params, const plugin::Setup& setup);

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
