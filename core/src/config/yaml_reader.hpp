#pragma once
// One YAML text to a tree without paths. The only file that knows the YAML library is yaml_reader.cpp.

#include <cstddef>
#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>
#include <dsc/config/yaml.hpp>
#include <memory>

namespace dsc::config {

/// What a text is read into and what it may cost.
struct ReadJob {
    std::shared_ptr<const SourceText> source;
    std::size_t begin = 0;  ///< byte of the text at which the YAML starts, on its first line
    const YamlOptions* options = nullptr;
    std::size_t* nodes_left = nullptr;   ///< shared by all files of a configuration
    Diagnostics* diagnostics = nullptr;  ///< faults that do not keep the rest from being read
    bool flow_only = false;              ///< refuses block lists and block maps
};

/// Throws ConfigError where the text is no YAML or exceeds a limit. The result needs NodeFactory::rooted.
ConfigNode read_yaml(const ReadJob& job);

}  // namespace dsc::config
