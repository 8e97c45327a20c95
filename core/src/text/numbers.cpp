// Numbers as text and back.
#include "dsc/text/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/core.h>

namespace dsc::text {
namespace {

template <class Value>
void append(std::string& out, Value value) {
    char digits[32];  // enough for every double and every 64-bit integer
    out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// std::from_chars accepts no plus sign, but files use it.
std::string_view without_plus(std::string_view word) {
    return word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+' ? word.substr(1)
                                                                                 : word;
}

template <class Value>
bool parse_whole(std::string_view word, Value& value) {
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && stop == end;
}

}  // namespace

void append_number(std::string& out, double value) { append(out, value); }
void append_number(std::string& out, float value) { append(out, value); }
void append_number(std::string& out, std::uint64_t value) { append(out, value); }

std::string exact(double value) {
    std::string out;
    append(out, value);
    return out;
}

std::string rounded(double value, int digits) { return fmt::format("{:.{}g}", value, digits); }

std::string fixed(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

Number parse_number(std::string_view word, double& value) {
    word = without_plus(word);
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return Number::not_a_number;
    if (error == std::errc::result_out_of_range) {
        // from_chars does not say whether the number is too large or too small; a negative exponent
        // means too small.
        const std::size_t exponent = word.find_first_of("eE");
        if (exponent == std::string_view::npos ||
            word.find('-', exponent) == std::string_view::npos)
            return Number::too_large;
        value = 0.0;
    }
    return std::isfinite(value) ? Number::ok : Number::not_finite;
}

bool parse_count(std::string_view word, std::size_t& value) { return parse_whole(word, value); }

bool parse_integer(std::string_view word, std::int64_t& value) {
    return parse_whole(without_plus(word), value);
}

bool has_decimal_comma(std::string_view word) {
    if (word.find(',') == std::string_view::npos || word.front() == ',' || word.back() == ',')
        return false;
    std::string digits(word);
    const auto commas = std::count(digits.begin(), digits.end(), ',');
    if (commas == 1 && digits.find('.') == std::string::npos) {
        digits[digits.find(',')] = '.';
    } else {  // thousands separators
        for (std::size_t at = word.find(','); at != std::string_view::npos;
             at = word.find(',', at + 1)) {
            if (word.find_first_of(",.", at + 1) != at + 4 && at + 4 != word.size()) return false;
        }
        digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
    }
    double value = 0.0;
    return parse_number(digits, value) == Number::ok;
}

}  // namespace dsc::text
