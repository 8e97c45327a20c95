#pragma once
// Reading text (lines, columns, numbers), and pieces of a file for messages.

#include <cstddef>
#include <string>
#include <string_view>

namespace dsc::cloud {

/// Iterates over the lines of a text with line ends LF, CR LF or CR; the ends are not part of a line.
class Lines {
public:
    explicit Lines(std::string_view text);
    /// False at the end of the text.
    bool next(std::string_view& line);
    /// Number of the last line, from 1.
    std::size_t number() const { return number_; }
    /// Whether the last line had a line end; a truncated file usually has none.
    bool terminated() const { return terminated_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
    bool terminated_ = true;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view trim(std::string_view text);

/// Removes the next run of non-blank characters from `rest`; empty at the end.
std::string_view next_word(std::string_view& rest);

enum class Number { ok, not_a_number, not_finite };

/// Reads the whole of `word` as a number, independent of the locale. A leading + is allowed, and numbers that are too small
/// become 0. "nan", "inf" and numbers that are too large are not_finite.
Number parse_number(std::string_view word, double& value);

/// Whether the word is a number apart from commas inside it: "1,5", "-2,5e3", "1,234.5".
bool has_decimal_comma(std::string_view word);

/// Reads the whole of `word` as a decimal integer of at least 0.
bool parse_count(std::string_view word, std::size_t& value);

/// 'word' for a message: at most 40 characters, with ? for unprintable ones.
std::string in_quotes(std::string_view word);

/// A number with up to 6 significant digits for a message.
std::string short_number(double value);

/// "1 point", "2 points".
std::string counted(std::size_t count, std::string_view noun);

}  // namespace dsc::cloud
