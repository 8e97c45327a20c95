#pragma once
// Environment variables in the strings of a configuration.

#include <string>
#include <string_view>

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/source.hpp>
#include <dsc/config/yaml.hpp>

namespace dsc::config {

/// `text` with its ${NAME} replaced; faults are added to `diagnostics` at `position`.
std::string expand_variables(std::string_view text, const SourcePosition& position,
                             const Environment& environment, Diagnostics& diagnostics);

/// Whether the original text at a position contains a variable.
bool holds_variable(const SourcePosition& position);

}  // namespace dsc::config
