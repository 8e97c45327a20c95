#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("clusters", DSC_VERSION, "BSD-3-Clause", "Filter that thins crowded points") {
    registrar.add<dsc::strategies::Clusters>("clusters", "removes points where many lie close together");
}
