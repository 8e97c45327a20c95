// Reads and writes numbers as text.
#include "io/text.hpp"

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>

#include <charconv>
#include <cmath>
#include <system_error>

namespace dsc::io {

void fail(const char* code, const Place& place, const std::string& cause, const std::string& remedy) {
    throw IoError(code, place.file, place.line > 0 ? std::to_string(place.line) : std::string{}, cause,
                  remedy);
}

std::string in_quotes(std::string_view token) {
    constexpr std::size_t longest = 32;
    std::string out = "'";
    for (const char c : token.substr(0, longest)) out += c >= ' ' && c <= '~' ? c : '?';
    if (token.size() > longest) out += "...";
    return out + "'";
}

namespace {
// std::from_chars accepts no plus sign, but files use it.
std::string_view without_plus(std::string_view token) {
    return token.size() > 1 && token[0] == '+' && token[1] != '-' ? token.substr(1) : token;
}
}  // namespace

double parse_value(std::string_view token, const Place& place) {
    const std::string_view digits = without_plus(token);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range && end == digits.data() + digits.size()) {
        fail("io.not_finite", place, in_quotes(token) + " is out of the range of a double", export_again);
    }
    if (error != std::errc{} || end != digits.data() + digits.size()) {
        const bool comma = token.find(',') != std::string_view::npos;
        fail("io.syntax", place, in_quotes(token) + " is not a number", comma ? std::string(decimal_comma_remedy) : export_again);
    }
    return value;
}

double parse_coordinate(std::string_view token, const Place& place) {
    const double value = parse_value(token, place);
    if (!std::isfinite(value)) {
        fail("io.not_finite", place, "coordinate " + in_quotes(token) + " is NaN or infinite",
             "remove the point and its faces or export the file again");
    }
    return value;
}

bool read_number(std::string_view token, double& value) {
    const std::string_view digits = without_plus(token);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc{} && end == digits.data() + digits.size() && std::isfinite(value);
}

std::int64_t parse_integer(std::string_view token, const Place& place) {
    const std::string_view digits = without_plus(token);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size()) {
        fail("io.syntax", place, in_quotes(token) + " is not an integer", export_again);
    }
    return value;
}

std::string counted(std::uint64_t count, std::string_view noun) {
    std::string out = std::to_string(count);
    out.append(" ").append(noun);
    if (count != 1) out += 's';
    return out;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string_view Fields::next() {
    std::size_t begin = 0;
    while (begin < rest_.size() && is_blank(rest_[begin])) ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !is_blank(rest_[end])) ++end;
    const std::string_view field = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return field;
}

std::string_view Lines::take() {
    const std::size_t end = rest_.find('\n');
    ended_ = end != std::string_view::npos;
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(ended_ ? end + 1 : rest_.size());
    ++taken_;
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

bool Lines::next(std::string_view& line) {
    if (rest_.empty()) return false;
    line = take();
    place_.line = taken_;
    if (!join_ || line.empty() || line.back() != '\\') return true;
    joined_.assign(line);
    while (!joined_.empty() && joined_.back() == '\\') {
        joined_.back() = ' ';
        if (rest_.empty()) break;
        joined_.append(take());
    }
    line = joined_;
    return true;
}

std::string_view Tokens::next() {
    std::size_t begin = 0;
    while (begin < rest_.size() && (is_blank(rest_[begin]) || rest_[begin] == '\n')) {
        if (rest_[begin] == '\n') ++line_;
        ++begin;
    }
    std::size_t end = begin;
    while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '\n') ++end;
    const std::string_view token = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    if (!token.empty()) place_.line = line_;
    return token;
}

bool Tokens::more_on_line() const {
    std::size_t at = 0;
    while (at < rest_.size() && is_blank(rest_[at])) ++at;
    return at < rest_.size() && rest_[at] != '\n';
}

std::string_view Tokens::require(std::string_view what) {
    const std::string_view token = next();
    if (token.empty())
        fail("io.truncated", place_, "the file ends where " + std::string(what) + " should be", copy_again);
    return token;
}

void append_number(std::string& out, double value) {
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    out.append(buffer, result.ptr);
}

void append_number(std::string& out, std::uint64_t value) {
    char buffer[24];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    out.append(buffer, result.ptr);
}

}  // namespace dsc::io
