#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("voxel_grid", DSC_VERSION, "BSD-3-Clause", "Filter that thins a cloud by a grid") {
    registrar.add<dsc::strategies::VoxelGrid>("voxel_grid", "keeps one point of each cell of a grid");
}
