#pragma once
// Reads one YAML text into a tree without paths. Only yaml_reader.cpp uses the YAML library.

#include <cstddef>
#include <memory>

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>
#include <dsc/config/yaml.hpp>

namespace dsc::config {

/// The target and the limits of reading a text.
struct ReadJob {
    std::shared_ptr<const SourceText> source;
    std::size_t begin = 0;  ///< byte of the text at which the YAML starts, on its first line
    const YamlOptions* options = nullptr;
    std::size_t* nodes_left = nullptr;   ///< shared by all files of a configuration
    Diagnostics* diagnostics = nullptr;  ///< faults after which the rest can still be read
    bool flow_only = false;              ///< refuses block lists and block maps
};

/// Throws ConfigError if the text is not YAML or exceeds a limit. The result needs
/// NodeFactory::rooted.
ConfigNode read_yaml(const ReadJob& job);

}  // namespace dsc::config
