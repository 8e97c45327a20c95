#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("dsc_file", DSC_VERSION, "BSD-3-Clause", "Start from a labelled tet mesh in a file") {
    registrar.add<dsc::strategies::DscFile>("dsc_file", "a labelled box of tets from a .dsc or .vtu file");
}
