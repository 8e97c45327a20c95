#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("curvature_flow", DSC_VERSION, "BSD-3-Clause", "Mean curvature flow of the interface") {
    registrar.add<dsc::strategies::CurvatureFlow>("curvature_flow", "moves the interface by mean curvature flow, -2 H N");
}
