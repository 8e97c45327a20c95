#pragma once
// UTF-8: its characters, and what of a text can be shown.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace dsc::text {

/// Number of bytes of the well-formed character at `begin`; 0 if there is none.
std::size_t character_length(std::string_view text, std::size_t begin = 0);

/// Number of characters in valid or broken UTF-8: the bytes that start a character.
std::size_t character_count(std::string_view text);

/// The first characters of the text, at most `most`.
std::string_view first_characters(std::string_view text, std::size_t most);

/// Byte offset of the first byte that is not text: a control character other than tab and line
/// ends, or broken UTF-8.
std::optional<std::size_t> first_non_text(std::string_view text);

/// True for well-formed UTF-8, control characters included.
bool is_utf8(std::string_view text);

/// The text in one line that is safe for a terminal, with one column per character: blanks in place
/// of tabs and line ends, `control` in place of other control characters, '?' in place of broken
/// bytes.
std::string printable(std::string_view text, char control = ' ');

}  // namespace dsc::text
