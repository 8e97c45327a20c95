#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("outliers", DSC_VERSION, "BSD-3-Clause", "Filter of points far from all others") {
    registrar.add<dsc::strategies::Outliers>("outliers", "removes points far from all others, and no points of a clean cloud");
}
