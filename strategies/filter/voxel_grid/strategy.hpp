#pragma once
// Filter `voxel_grid`: keeps one point of each cell of a grid.

#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// cloud::voxel_grid as a filter of experiments.
class VoxelGrid final : public hooks::CloudFilter {
public:
    using Params = cloud::VoxelGridOptions;
    static void declare(config::ParamSchema<Params>& schema);

    VoxelGrid(const Params& params, const plugin::Setup& setup);

    cloud::Filtered apply(const cloud::Cloud& cloud, const hooks::FilterContext& context) override;

private:
    Params params_;
};

}  // namespace dsc::strategies
