#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("average", DSC_VERSION, "BSD-3-Clause", "Smoothing of the interface by averages") {
    registrar.add<dsc::strategies::Average>("average", "moves vertices towards the mean of their neighbours");
}
