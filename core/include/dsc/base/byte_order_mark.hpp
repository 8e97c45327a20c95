#pragma once
// Detects the byte order mark that some programs write at the start of a text.

#include <string_view>

namespace dsc {

/// The text after the UTF-8 mark; the whole text if there is no mark. [parallel]
constexpr std::string_view without_byte_order_mark(std::string_view text) noexcept {
    return text.substr(0, 3) == "\xEF\xBB\xBF" ? text.substr(3) : text;
}

/// Whether the text begins with a mark of UTF-16 or UTF-32, which no reader of the library accepts.
/// [parallel]
constexpr bool has_wide_byte_order_mark(std::string_view text) noexcept {
    const std::string_view begin = text.substr(0, 2);
    return begin == "\xFF\xFE" || begin == "\xFE\xFF" ||
           text.substr(0, 4) == std::string_view("\0\0\xFE\xFF", 4);
}

/// Cause and remedy in messages about such a text.
inline constexpr std::string_view wide_text_cause = "the text is in UTF-16 or UTF-32";
inline constexpr std::string_view wide_text_remedy = "save it as UTF-8 or plain ASCII";

/// The remedy for a number with a decimal comma, in every format.
inline constexpr std::string_view decimal_comma_remedy =
    "write decimals with a point, not with a comma";

}  // namespace dsc
