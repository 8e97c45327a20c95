#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("remesh", DSC_VERSION, "BSD-3-Clause", "Remeshing of the interface to edges of one length") {
    registrar.add<dsc::strategies::Remesh>(
        "remesh", "splits, collapses and flips interface edges until they have the length that the cloud's points are worth");
}
