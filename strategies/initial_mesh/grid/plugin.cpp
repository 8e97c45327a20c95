#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("grid", DSC_VERSION, "BSD-3-Clause", "Start from a regular box of tetrahedra that contains simple shapes") {
    registrar.add<dsc::strategies::Grid>("grid", "a box of equal cells with five tets each; shapes are added and cut");
}
