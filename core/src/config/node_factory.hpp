#pragma once
// Builds trees for the YAML reader: first without paths; one pass over the finished tree adds them.

#include <vector>

#include <dsc/config/node.hpp>

namespace dsc::config {

/// Lists and maps with unchanged children: no paths, no check of keys.
struct NodeFactory {
    static ConfigNode list(std::vector<ConfigNode> items, SourcePosition position);
    static ConfigNode map(std::vector<ConfigEntry> entries, SourcePosition position);
    /// The tree with the paths of all its nodes; `node` is the root.
    static ConfigNode rooted(const ConfigNode& node);
};

}  // namespace dsc::config
