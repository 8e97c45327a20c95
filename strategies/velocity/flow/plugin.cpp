#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("flow", DSC_VERSION, "BSD-3-Clause", "Advection of the interface by analytic velocity fields") {
    registrar.add<dsc::strategies::Flow>("flow", "moves the interface with an analytic velocity field");
}
