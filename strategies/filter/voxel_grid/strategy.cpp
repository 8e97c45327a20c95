// Filter `voxel_grid`: keeps one point of each cell of a grid.
//
// In each occupied cell the point nearest to the mean of the cell's points stays. The algorithm is
// dsc::cloud::voxel_grid.
#include <dsc/base/version.hpp>
#include <dsc/cloud/filter.hpp>
#include <dsc/hooks/cloud_filter.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

class VoxelGrid final : public dsc::hooks::CloudFilter {
public:
    /// The parameters that an experiment may set.
    using Params = dsc::cloud::VoxelGridOptions;
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.real("size", &Params::size)
            .range(0, 1, "diagonals")
            .open_low()
            .doc("Edge of a cell; one point of each occupied cell stays.");
    }

    VoxelGrid(const Params& params, const dsc::plugin::Setup&) : params_(params) {}

    dsc::cloud::Filtered apply(const dsc::cloud::Cloud& cloud,
                               const dsc::hooks::FilterContext&) override {
        return dsc::cloud::voxel_grid(cloud, params_);
    }

private:
    Params params_;
};

}  // namespace

DSC_PLUGIN("voxel_grid", DSC_VERSION, "BSD-3-Clause", "Filter that thins a cloud by a grid") {
    registrar.add<VoxelGrid>("voxel_grid", "keeps one point of each cell of a grid");
}
