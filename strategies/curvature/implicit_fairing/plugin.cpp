#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("implicit_fairing", DSC_VERSION, "BSD-3-Clause", "Mean curvature by cotangent weights") {
    registrar.add<dsc::strategies::ImplicitFairing>(
        "implicit_fairing", "signed mean curvature by cotangent weights (Desbrun et al. 1999)");
}
