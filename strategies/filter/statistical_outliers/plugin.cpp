#include <dsc/base/version.hpp>
#include <dsc/plugin/plugin.hpp>

#include "strategy.hpp"

DSC_PLUGIN("statistical_outliers", DSC_VERSION, "BSD-3-Clause", "Filter of points far from their neighbours") {
    registrar.add<dsc::strategies::StatisticalOutliers>("statistical_outliers",
                                                              "removes points whose neighbours are unusually far away");
}
