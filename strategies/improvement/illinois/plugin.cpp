#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("illinois", DSC_VERSION, "BSD-3-Clause", "Repairs of flat tets by their class: wedge, tee, cap, sliver") {
    registrar.add<dsc::strategies::IllinoisImprovement>("illinois", "repairs flat tets by their class, and no others");
}
