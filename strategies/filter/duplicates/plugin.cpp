#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("duplicates", DSC_VERSION, "BSD-3-Clause", "Filter of repeated points") {
    registrar.add<dsc::strategies::Duplicates>("duplicates", "removes points that repeat an earlier one");
}
