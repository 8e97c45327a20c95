#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("radius_outliers", DSC_VERSION, "BSD-3-Clause", "Filter of isolated points") {
    registrar.add<dsc::strategies::RadiusOutliers>("radius_outliers", "removes points with few neighbours");
}
