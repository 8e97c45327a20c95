#pragma once
// How the YAML reader builds trees: without paths first, which one pass over the finished tree adds.

#include <dsc/config/node.hpp>
#include <string>
#include <vector>

namespace dsc::config {

/// Lists and maps whose children are taken as they are: no paths, no check of keys.
struct NodeFactory {
    static ConfigNode list(std::vector<ConfigNode> items, SourcePosition position);
    static ConfigNode map(std::vector<ConfigEntry> entries, SourcePosition position);
    /// The tree with the paths of all its nodes, this one the root.
    static ConfigNode rooted(const ConfigNode& node);
};

}  // namespace dsc::config
