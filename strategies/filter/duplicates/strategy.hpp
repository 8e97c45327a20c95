#pragma once
// Filter `duplicates`: removes points that repeat an earlier one.

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// cloud::remove_duplicates as a filter of experiments.
class Duplicates final : public hooks::CloudFilter {
public:
    using Params = cloud::DuplicatesOptions;
    static void declare(config::ParamSchema<Params>& schema);

    Duplicates(const Params& params, const plugin::Setup& setup);

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
