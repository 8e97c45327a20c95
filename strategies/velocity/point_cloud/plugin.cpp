#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("point_cloud", DSC_VERSION, "BSD-3-Clause", "Attraction of the interface to a point cloud") {
    registrar.add<dsc::strategies::PointCloud>("point_cloud",
                                               "to the nearest cloud point along the normal, less curvature");
}
