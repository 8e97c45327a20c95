#include "strategy.hpp"

namespace dsc::strategies {

void VoxelGrid::declare(config::ParamSchema<Params>& schema) {
    schema.real("size", &Params::size)
        .range(0, 1)
        .open_low()
        .unit("diagonals")
        .doc("Edge of a cell; one point of each occupied cell stays.");
}

VoxelGrid::VoxelGrid(const Params& params, const plugin::Setup&) : params_(params) {}

cloud::Filtered VoxelGrid::apply(const cloud::Cloud& cloud, const hooks::FilterContext&) {
    return cloud::voxel_grid(cloud, params_);
}

}  // namespace dsc::strategies
