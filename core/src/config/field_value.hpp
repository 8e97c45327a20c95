#pragma once
// The value of one field without a schema of its own: scalars and lists of scalars.

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>
#include <dsc/config/schema.hpp>
#include <string>

namespace dsc::config {

/// True for the types that resolve_value() knows.
bool is_plain_field(FieldType type);

/// Checks a given value and brings it into the field's type. `path` names it in messages, `fallback` is the
/// place for a value that has none.
ConfigNode resolve_value(const Field& field, const ConfigNode& node, const std::string& path,
                         const SourcePosition& fallback, Diagnostics& diagnostics);

/// A number as people write it: "1", not "1.0".
std::string number_text(const ConfigNode& node);
std::string bound_text(const Field& field, double bound);

/// "the string 'fast'", "2.5", "a list": a given value as it reads in a message.
std::string value_text(const ConfigNode& node);

}  // namespace dsc::config
