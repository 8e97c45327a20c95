// Reads plain scalars by the rules of JSON.
#include "config/scalar.hpp"

#include <charconv>
#include <system_error>

#include <dsc/text/words.hpp>

namespace dsc::config {
namespace {

std::size_t skip_digits(std::string_view text, std::size_t at) {
    while (at < text.size() && text::is_digit(text[at])) ++at;
    return at;
}

enum class Number { none, integer, real };

/// The grammar of JSON: -?(0|[1-9][0-9]*)(.[0-9]+)?([eE][+-]?[0-9]+)?
Number number_form(std::string_view text) {
    std::size_t at = !text.empty() && text[0] == '-' ? 1 : 0;
    const std::size_t whole = at;
    at = skip_digits(text, at);
    if (at == whole || (text[whole] == '0' && at - whole > 1)) return Number::none;
    if (at == text.size()) return Number::integer;
    if (text[at] == '.') {
        const std::size_t fraction = at + 1;
        at = skip_digits(text, fraction);
        if (at == fraction) return Number::none;
    }
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        ++at;
        if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
        const std::size_t exponent = at;
        at = skip_digits(text, exponent);
        if (at == exponent) return Number::none;
    }
    return at == text.size() ? Number::real : Number::none;
}

bool is_infinity_or_nan(std::string_view text) {
    std::string word = text::lower_case(text);
    if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.erase(0, 1);
    return word == ".inf" || word == ".nan";
}

}  // namespace

bool is_null_text(std::string_view text) {
    return text.empty() || text == "~" || text == "null" || text == "Null" || text == "NULL";
}

PlainScalar read_plain(std::string_view text) {
    if (is_null_text(text)) return {ConfigNode(), {}};
    if (text == "true") return {ConfigNode(true), {}};
    if (text == "false") return {ConfigNode(false), {}};
    if (is_infinity_or_nan(text))
        return {ConfigNode(), text::in_quotes(text) + " is not a finite number"};
    const Number form = number_form(text);
    if (form == Number::none) return {ConfigNode(text), {}};
    const char* const begin = text.data();
    const char* const end = begin + text.size();
    if (form == Number::integer) {
        std::int64_t integer = 0;
        if (std::from_chars(begin, end, integer).ec == std::errc())
            return {ConfigNode(integer), {}};
    }
    double real = 0;
    if (std::from_chars(begin, end, real).ec != std::errc()) {
        return {ConfigNode(), text::in_quotes(text) + " does not fit a double"};
    }
    return {ConfigNode(real), {}};
}

std::string number_hint(std::string_view text) {
    if (number_form(text) != Number::none) return "remove the quotes";
    if (text.empty()) return {};
    std::string repaired(text);
    if (repaired[0] == '+') repaired.erase(0, 1);
    const bool negative = !repaired.empty() && repaired[0] == '-';
    const std::string sign = negative ? "-" : "";
    std::string digits = repaired.substr(negative ? 1 : 0);
    if (const std::size_t comma = digits.find(','); comma != std::string::npos) digits[comma] = '.';
    while (digits.size() > 1 && digits[0] == '0' && text::is_digit(digits[1])) digits.erase(0, 1);
    if (!digits.empty() && digits[0] == '.') digits.insert(0, "0");
    if (const std::size_t dot = digits.find('.');
        dot != std::string::npos &&
        (dot + 1 == digits.size() || !text::is_digit(digits[dot + 1]))) {
        digits.insert(dot + 1, "0");
    }
    repaired = sign + digits;
    return number_form(repaired) == Number::none ? std::string() : "write " + repaired;
}

std::string boolean_hint(std::string_view text) {
    const std::string word = text::lower_case(text);
    if (text == "true" || text == "false") return "remove the quotes";
    if (word == "yes" || word == "on" || word == "y" || word == "true") return "write true";
    if (word == "no" || word == "off" || word == "n" || word == "false") return "write false";
    return {};
}

}  // namespace dsc::config
