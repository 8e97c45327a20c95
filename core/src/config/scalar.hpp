#pragma once
// What a plain (unquoted) YAML scalar means: as in JSON, nothing else.

#include <dsc/config/node.hpp>
#include <string>
#include <string_view>

namespace dsc::config {

/// A scalar read by the rules of JSON, or why it cannot be.
struct PlainScalar {
    ConfigNode value;   ///< null, boolean, integer, real, or the text itself as a string
    std::string fault;  ///< not empty for `.inf`, `.nan` and numbers beyond a double
};
PlainScalar read_plain(std::string_view text);

/// True where the text stands for a null in YAML: "", "~", "null", "Null", "NULL".
bool is_null_text(std::string_view text);

/// How to write what was probably meant, for a field that wants a number and got this string: "0123", ".5",
/// "1,5". Empty where it looks like no number at all.
std::string number_hint(std::string_view text);

/// The same for a boolean: "yes", "True".
std::string boolean_hint(std::string_view text);

}  // namespace dsc::config
