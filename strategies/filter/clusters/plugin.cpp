#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("clusters", DSC_VERSION, "BSD-3-Clause", "Filter of crowded points") {
    registrar.add<dsc::strategies::Clusters>("clusters", "thins places where points crowd together");
}
