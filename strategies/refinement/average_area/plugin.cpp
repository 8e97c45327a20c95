#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("average_area", DSC_VERSION, "BSD-3-Clause", "Splitting of large interface faces") {
    registrar.add<dsc::strategies::AverageArea>("average_area",
                                                "splits interface faces of at least the average area");
}
