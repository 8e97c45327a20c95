#pragma once
// Small helpers on UTF-8 text, for messages and for refusing what is no text.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::config {

/// Characters in valid or broken UTF-8: bytes that start one.
std::size_t character_count(std::string_view text);

/// Byte offset of the first byte that is no text: a control character other than tab and line ends, or broken
/// UTF-8.
std::optional<std::size_t> first_non_text(std::string_view text);

/// True for well-formed UTF-8, control characters included.
bool is_utf8(std::string_view text);

/// The text with control characters as blanks and broken bytes as '?', safe for a terminal; one column each.
std::string printable(std::string_view text);

/// "1 item", "3 items".
std::string items_text(std::size_t count);

/// Where a word stands in a text, npos where it is only part of others.
std::size_t find_word(std::string_view text, std::string_view word);

/// 'text' in quotes for a message, printable and shortened to some 60 characters.
std::string quoted_text(std::string_view text);

}  // namespace dsc::config
