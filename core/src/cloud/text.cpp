// Lines, columns and numbers of text clouds.
#include "text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace dsc::cloud {

Lines::Lines(std::string_view text) : rest_(text) {}

bool Lines::next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = rest_.find_first_of("\r\n");
    line = rest_.substr(0, end);
    terminated_ = end != std::string_view::npos;
    if (terminated_) {
        const bool both = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
        rest_.remove_prefix(end + (both ? 2 : 1));
    } else {
        rest_ = {};
    }
    ++number_;
    return true;
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view next_word(std::string_view& rest) {
    std::size_t begin = 0;
    while (begin < rest.size() && is_blank(rest[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest.size() && !is_blank(rest[end])) ++end;
    const std::string_view word = rest.substr(begin, end - begin);
    rest.remove_prefix(end);
    return word;
}

Number parse_number(std::string_view word, double& value) {
    if (word.size() > 1 && word.front() == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument) return Number::not_a_number;
    if (error == std::errc::result_out_of_range) {
        // from_chars does not say whether the number is too large or too small; a negative exponent means too small.
        const std::size_t exponent = word.find_first_of("eE");
        if (exponent == std::string_view::npos || word.find('-', exponent) == std::string_view::npos)
            return Number::not_finite;
        value = 0.0;
    }
    return std::isfinite(value) ? Number::ok : Number::not_finite;
}

bool parse_count(std::string_view word, std::size_t& value) {
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return error == std::errc() && stop == end;
}

bool has_decimal_comma(std::string_view word) {
    if (word.find(',') == std::string_view::npos || word.front() == ',' || word.back() == ',') return false;
    std::string digits(word);
    const auto commas = std::count(digits.begin(), digits.end(), ',');
    if (commas == 1 && digits.find('.') == std::string::npos) {
        digits[digits.find(',')] = '.';
    } else {  // thousands separators
        for (std::size_t at = word.find(','); at != std::string_view::npos; at = word.find(',', at + 1)) {
            if (word.find_first_of(",.", at + 1) != at + 4 && at + 4 != word.size()) return false;
        }
        digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
    }
    double value = 0.0;
    return parse_number(digits, value) == Number::ok;
}

std::string in_quotes(std::string_view word) {
    constexpr std::size_t longest = 40;
    std::string text = "'";
    for (const char c : word.substr(0, longest)) text += (c >= ' ' && c <= '~') ? c : '?';
    if (word.size() > longest) text += "...";
    return text += "'";
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::string counted(std::size_t count, std::string_view noun) {
    std::string text = std::to_string(count);
    text.append(" ").append(noun);
    if (count != 1) text += 's';
    return text;
}

}  // namespace dsc::cloud
