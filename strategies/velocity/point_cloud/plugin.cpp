#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("point_cloud", DSC_VERSION, "BSD-3-Clause", "Attraction of the interface to a point cloud") {
    registrar.add<dsc::strategies::PointCloud>("point_cloud",
                                               "moves vertices along their normals towards the nearest cloud point, minus "
                                               "curvature");
}
