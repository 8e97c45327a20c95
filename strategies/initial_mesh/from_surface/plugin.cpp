#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("from_surface", DSC_VERSION, "BSD-3-Clause", "Start from a closed surface in a file") {
    registrar.add<dsc::strategies::FromSurface>("from_surface",
                                                "a graded box of tets, snapped to a closed surface from a file");
}
