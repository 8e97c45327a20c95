#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("hidden", DSC_VERSION, "BSD-3-Clause", "Filter of points that lie inside") {
    registrar.add<dsc::strategies::Hidden>("hidden", "removes points that no view from outside can see");
}
