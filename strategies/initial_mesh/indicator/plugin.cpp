#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("indicator", DSC_VERSION, "BSD-3-Clause", "Start with inside and outside determined from the cloud alone") {
    registrar.add<dsc::strategies::Indicator>(
        "indicator", "a graded lattice labelled by the winding field of the oriented cloud, with a controlled topology");
}
