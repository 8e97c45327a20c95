#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("angular_defect", DSC_VERSION, "BSD-3-Clause", "Curvature from the angles around a vertex") {
    registrar.add<dsc::strategies::AngularDefect>("angular_defect",
                                                  "2 pi minus the sum of the angles at the vertex");
}
