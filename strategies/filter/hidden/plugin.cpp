#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("hidden", DSC_VERSION, "BSD-3-Clause", "Filter that removes points inside the object") {
    registrar.add<dsc::strategies::Hidden>("hidden", "removes points that no view from outside can see");
}
