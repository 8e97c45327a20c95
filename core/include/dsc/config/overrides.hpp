#pragma once
// Overrides of the command line: `velocity.alpha=0.3`, `schedule.0.steps=5`.

#include <span>
#include <string>

#include <dsc/config/node.hpp>
#include <dsc/config/yaml.hpp>

namespace dsc::config {

/// Applies `a.b=value` one after the other and returns the changed tree. Numbers in the path are
/// indices of lists; the item must exist. The value is a YAML scalar or a flow list or map and
/// replaces the old value. A missing key is added; the schema checks it later. All malformed
/// overrides are reported in one ConfigError "config.override". [setup]
ConfigNode apply_overrides(const ConfigNode& root, std::span<const std::string> overrides,
                           const YamlOptions& options = {});

/// The same for one value in a file, such as a value of a sweep: `value` is set at the dotted
/// `path`, which is written at `key`. Faults of the value are reported at its own place. Throws
/// ConfigError "config.override". [setup]
ConfigNode with_value(const ConfigNode& root, const std::string& path, const ConfigNode& value,
                      const SourcePosition& key);

/// A value as written to the right of `key=`: one line, lists and maps in flow style. It reads back
/// as an equal tree. Throws ConfigError as to_yaml().
std::string flow_text(const ConfigNode& node);

}  // namespace dsc::config
