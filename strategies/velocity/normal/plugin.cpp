#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("normal", DSC_VERSION, "BSD-3-Clause", "Growth of the interface along its normals") {
    registrar.add<dsc::strategies::Normal>("normal", "moves vertices along their normals with constant speed");
}
