#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("lattice", DSC_VERSION, "BSD-3-Clause", "Graded box of tetrahedra with simple shapes in it") {
    registrar.add<dsc::strategies::Lattice>(
        "lattice", "a box of cells, fine at the shapes' surface, coarse away from it");
}
