#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("remesh", DSC_VERSION, "BSD-3-Clause", "Remeshing of the interface to edges of one length") {
    registrar.add<dsc::strategies::Remesh>(
        "remesh", "splits, collapses and flips interface edges until their length suits the number of points of the cloud");
}
