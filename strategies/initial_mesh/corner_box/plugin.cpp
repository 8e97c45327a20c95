#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("corner_box", DSC_VERSION, "BSD-3-Clause", "Start from a sphere or box joined to the corners of the outer box") {
    registrar.add<dsc::strategies::CornerBox>("corner_box", "a sphere or box joined to the eight corners of the outer box, "
                                                            "with no vertices between them");
}
