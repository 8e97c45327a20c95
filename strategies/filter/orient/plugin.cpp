#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("orient", DSC_VERSION, "BSD-3-Clause", "Filter that determines inside and outside") {
    registrar.add<dsc::strategies::Orient>("orient", "gives points normals that point out of the solid, and areas");
}
