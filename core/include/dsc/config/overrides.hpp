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

/// The same for one value that stands in a file, as a sweep has them: `value` at the dotted `path`, which is written at
/// `key`. Faults of the value are told at its own place. Throws ConfigError "config.override". [setup]
ConfigNode with_value(const ConfigNode& root, const std::string& path, const ConfigNode& value,
                      const SourcePosition& key);

/// A value as it stands on the right of `key=`: one line, lists and maps in flow style. Reads back as an equal tree.
/// Throws ConfigError like to_yaml().
std::string flow_text(const ConfigNode& node);

}  // namespace dsc::config
