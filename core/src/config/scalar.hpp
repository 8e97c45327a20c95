#pragma once
// The meaning of a plain (unquoted) YAML scalar: exactly as in JSON.

#include <string>
#include <string_view>

#include <dsc/config/node.hpp>

namespace dsc::config {

/// A scalar read by the rules of JSON, or the reason why it cannot be read.
struct PlainScalar {
    ConfigNode value;   ///< null, boolean, integer, real, or the text itself as a string
    std::string fault;  ///< not empty for `.inf`, `.nan` and numbers beyond a double
};
PlainScalar read_plain(std::string_view text);

/// True if the text means null in YAML: "", "~", "null", "Null", "NULL".
bool is_null_text(std::string_view text);

/// Suggests the intended spelling for a field that wants a number and got this string: "0123",
/// ".5", "1,5". Empty if it does not look like a number.
std::string number_hint(std::string_view text);

/// The same for a boolean: "yes", "True".
std::string boolean_hint(std::string_view text);

}  // namespace dsc::config
