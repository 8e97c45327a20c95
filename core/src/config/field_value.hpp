#pragma once
// The value of one field that is not a map: scalars and lists of scalars.

#include <string>

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>
#include <dsc/config/schema.hpp>

namespace dsc::config {

/// True for the types that resolve_value() supports.
bool is_plain_field(FieldType type);

/// Checks a given value and converts it to the field's type. Messages call it `path`; `fallback` is
/// the place of a value without its own place.
ConfigNode resolve_value(const Field& field, const ConfigNode& node, const std::string& path,
                         const SourcePosition& fallback, Diagnostics& diagnostics);

/// A number as people write it: "1", not "1.0".
std::string number_text(const ConfigNode& node);
std::string bound_text(const Field& field, double bound);

/// A given value as messages show it: "the string 'fast'", "2.5", "a list".
std::string value_text(const ConfigNode& node);

}  // namespace dsc::config
