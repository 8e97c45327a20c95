#pragma once
// Overrides of the command line: `velocity.alpha=0.3`, `schedule.0.steps=5`.

#include <dsc/config/node.hpp>
#include <dsc/config/yaml.hpp>
#include <span>
#include <string>

namespace dsc::config {

/// Applies `a.b=value` one after the other and returns the changed tree. Numbers in the path index lists,
/// which must have the item. The value is a YAML scalar or flow list or map and replaces what was there. A
/// key that is not there is added (a schema judges it later). All malformed overrides are reported in one
/// ConfigError "config.override". [setup]
ConfigNode apply_overrides(const ConfigNode& root, std::span<const std::string> overrides,
                           const YamlOptions& options = {});

}  // namespace dsc::config
