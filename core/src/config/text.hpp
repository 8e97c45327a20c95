#pragma once
// Small helpers on UTF-8 text, for messages and for refusing bytes that are not text.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::config {

/// Number of characters in valid or broken UTF-8: the bytes that start a character.
std::size_t character_count(std::string_view text);

/// Byte offset of the first byte that is not text: a control character other than tab and line ends, or broken UTF-8.
std::optional<std::size_t> first_non_text(std::string_view text);

/// True for well-formed UTF-8, control characters included.
bool is_utf8(std::string_view text);

/// The text with blanks in place of control characters and '?' in place of broken bytes: safe for a terminal, one column each.
std::string printable(std::string_view text);

/// "1 item", "3 items".
std::string items_text(std::size_t count);

/// Position of a word in a text; npos if it occurs only as a part of other words.
std::size_t find_word(std::string_view text, std::string_view word);

/// 'text' in quotes for a message, printable, shortened to about 60 characters.
std::string quoted_text(std::string_view text);

}  // namespace dsc::config
