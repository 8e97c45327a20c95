#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("analytic", DSC_VERSION, "BSD-3-Clause", "Error of the interface against a known solution") {
    registrar.add<dsc::strategies::Analytic>("analytic", "compares the interface with a known solution");
}
