#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("centroid_speed", DSC_VERSION, "BSD-3-Clause", "Splitting of faces that rest away from their target") {
    registrar.add<dsc::strategies::CentroidSpeed>(
        "centroid_speed", "splits interface faces whose vertices rest while their centroid would move");
}
