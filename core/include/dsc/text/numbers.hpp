#pragma once
// Numbers as text and back, independent of the locale.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dsc::text {

/// Appends the shortest text that reads back to the same number.
void append_number(std::string& out, double value);
void append_number(std::string& out, float value);
void append_number(std::string& out, std::uint64_t value);

/// The shortest text that reads back to the same number.
std::string exact(double value);

/// With at most this many significant digits, as "%g" writes them: "0.1", "1e-07".
std::string rounded(double value, int digits = 6);

/// With this many digits after the point, as "%f" writes them.
std::string fixed(double value, int digits);

enum class Number { ok, not_a_number, not_finite, too_large };

/// Reads the whole of `word` as a number. A leading + is allowed, and numbers that are too small
/// become 0. "nan" and "inf" are not_finite and set `value`; numbers beyond the range of a double
/// are too_large and do not.
Number parse_number(std::string_view word, double& value);

/// Whether the word is a number apart from commas inside it: "1,5", "-2,5e3", "1,234.5".
bool has_decimal_comma(std::string_view word);

/// Reads the whole of `word` as a decimal integer of at least 0.
bool parse_count(std::string_view word, std::size_t& value);

/// Reads the whole of `word` as a decimal integer; a leading + is allowed.
bool parse_integer(std::string_view word, std::int64_t& value);

}  // namespace dsc::text
