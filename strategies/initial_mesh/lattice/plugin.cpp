#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("lattice", DSC_VERSION, "BSD-3-Clause", "Start from a graded box of tetrahedra that contains simple shapes") {
    registrar.add<dsc::strategies::Lattice>(
        "lattice", "a box of cells, fine at the surface of the shapes, coarse away from it");
}
