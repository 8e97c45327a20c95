#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("dsc", DSC_VERSION, "BSD-3-Clause", "Quality-driven mesh improvement") {
    registrar.add<dsc::strategies::DscImprovement>("dsc", "smooths, flips, collapses and splits by quality and size");
}
