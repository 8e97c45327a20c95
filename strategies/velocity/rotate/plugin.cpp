#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("rotate", DSC_VERSION, "BSD-3-Clause", "Rigid rotation of the interface") {
    registrar.add<dsc::strategies::Rotate>("rotate", "rotates the interface about an axis");
}
