#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("grid", DSC_VERSION, "BSD-3-Clause", "Regular box of tetrahedra with simple shapes in it") {
    registrar.add<dsc::strategies::Grid>("grid", "a box of equal cells, five tets each; shapes add and cut");
}
