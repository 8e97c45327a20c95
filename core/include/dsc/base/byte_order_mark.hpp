#pragma once
// The mark that some programs put in front of a text.

#include <string_view>

namespace dsc {

/// The text behind the mark of UTF-8, if it has one. [parallel]
constexpr std::string_view without_byte_order_mark(std::string_view text) noexcept {
    return text.substr(0, 3) == "\xEF\xBB\xBF" ? text.substr(3) : text;
}

/// Whether the text begins with a mark of UTF-16 or UTF-32, which no reader of ours takes. [parallel]
constexpr bool has_wide_byte_order_mark(std::string_view text) noexcept {
    const std::string_view begin = text.substr(0, 2);
    return begin == "\xFF\xFE" || begin == "\xFE\xFF" || text.substr(0, 4) == std::string_view("\0\0\xFE\xFF", 4);
}

/// What a message says of such a text, and what helps.
inline constexpr std::string_view wide_text_cause = "the text is in UTF-16 or UTF-32";
inline constexpr std::string_view wide_text_remedy = "save it as UTF-8 or plain ASCII";

/// The remedy for a number with a decimal comma, in every format.
inline constexpr std::string_view decimal_comma_remedy = "write decimals with a point, not with a comma";

}  // namespace dsc
