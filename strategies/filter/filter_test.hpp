#pragma once
// What the tests of the filters share. The plugin is loaded as in a run.

#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include <dsc/sdk/filters.hpp>

using dsc::Vec3;
using dsc::cloud::Cloud;
using dsc::cloud::Filtered;
using dsc::config::ConfigNode;

/// The cloud after the filter of the tested plugin, which has the name of its library:
/// libdsc_NAME.so.
inline Filtered filtered(const Cloud& cloud, const ConfigNode& params = ConfigNode::map()) {
    const std::string library = std::filesystem::path(DSC_TEST_PLUGIN).stem().string();
    return dsc::sdk::filtered(DSC_TEST_PLUGIN, library.substr(library.find('_') + 1), cloud,
                              params);
}

/// The grid and two points far above it, one of them first.
inline Cloud grid_with_outliers() {
    Cloud cloud = dsc::sdk::square_grid(12);
    cloud.points.insert(cloud.points.begin(), Vec3(5, 5, 40));
    cloud.confidence.insert(cloud.confidence.begin(), 1.0);
    cloud.points.emplace_back(5, 5, 60);
    cloud.confidence.push_back(1.0);
    return cloud;
}
