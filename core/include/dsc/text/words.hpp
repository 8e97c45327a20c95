#pragma once
// Words of texts and messages: blanks, case, names, quotes, plurals.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace dsc::text {

/// Blank, tab, carriage return, vertical tab, form feed; not line feed.
constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
constexpr bool is_letter(char c) { return is_lower(c) || (c >= 'A' && c <= 'Z'); }

/// The text without blanks at both ends.
std::string_view trim(std::string_view text);

/// Removes the next run of non-blank characters from `rest`; empty at the end.
std::string_view next_word(std::string_view& rest);

/// Position of a word in a text; npos if it occurs only as a part of other words.
std::size_t find_word(std::string_view text, std::string_view word);

/// With a to z in place of A to Z, independent of the locale; other characters stay.
std::string lower_case(std::string_view text);

/// The extension of a path in lower case, with its dot: ".ply"; empty if there is none.
std::string lower_case_extension(const std::filesystem::path& file);

/// Lower-case letters, digits and '_', at least one of them: the names of columns, keys and
/// attributes.
bool is_snake_case(std::string_view name);

/// [A-Za-z_][A-Za-z0-9_]*
bool is_identifier(std::string_view name);

/// [a-z][a-z0-9_]*: the names of plugins and strategies.
bool is_id(std::string_view name);

/// 'text' for a message: one line of at most 60 characters; blanks in place of tabs and line ends,
/// '?' in place of other control characters and of bytes that are not UTF-8.
std::string in_quotes(std::string_view text);

/// A number with its noun: "1 point", "2 points". `many` is the plural if it is not the noun with
/// an s.
std::string counted(std::uint64_t count, std::string_view noun, std::string_view many = {});

}  // namespace dsc::text
