#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("surface_fit", DSC_VERSION, "BSD-3-Clause", "Least-squares fit of the interface to a point cloud") {
    registrar.add<dsc::strategies::SurfaceFit>("surface_fit",
                                               "moves the whole surface to where a smooth surface with creases fits the cloud "
                                               "best");
}
