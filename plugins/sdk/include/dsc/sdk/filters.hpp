#pragma once
// Clouds and calls for tests of filters.

#include <string>

#include <dsc/config/node.hpp>
#include <dsc/hooks/cloud_filter.hpp>

namespace dsc::sdk {

/// Applies the filter `id` of the plugin `library` to the cloud. Throws as Host::load,
/// Catalogue::create and the filter.
cloud::Filtered filtered(const std::string& library, const std::string& id,
                         const cloud::Cloud& cloud,
                         const config::ConfigNode& params = config::ConfigNode::map());

/// The corners of a square grid of cells of edge 1 in the plane z = 0, side * side points. The
/// confidence of each point is its index in thousandths.
cloud::Cloud square_grid(int side);

}  // namespace dsc::sdk
