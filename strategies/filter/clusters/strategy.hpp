#pragma once
// Filter `clusters`: removes points where many lie close together.

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// cloud::remove_clusters as a filter of experiments.
class Clusters final : public hooks::CloudFilter {
public:
    using Params = cloud::ClustersOptions;
    static void declare(config::ParamSchema<Params>& schema);

    Clusters(const Params& params, const plugin::Setup& setup);

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
