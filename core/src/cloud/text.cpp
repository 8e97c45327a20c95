#include "text.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>
#include <system_error>

#include <dsc/base/byte_order_mark.hpp>
#include <dsc/base/error.hpp>

namespace dsc::cloud {
namespace fs = std::filesystem;

namespace {
[[noreturn]] void unreadable(const fs::path& path, int error) {
    throw IoError("io.unreadable", path.string(), "",
                  "cannot be read: " + std::generic_category().message(error),
                  "check its permissions and the disk");
}
}  // namespace

std::string read_file(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found)
        throw IoError("io.missing", path.string(), "", "no such file", "check the path");
    if (error) unreadable(path, error.value());
    if (status.type() == fs::file_type::directory)
        throw IoError("io.directory", path.string(), "", "is a folder", "name a file in it");
    if (status.type() != fs::file_type::regular)
        throw IoError("io.unreadable", path.string(), "", "is not a regular file",
                      "copy the data into a file first");

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
    if (!file) unreadable(path, errno);
    std::string text;
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error) text.reserve(size);
    char block[1 << 16];
    while (const std::size_t got = std::fread(block, 1, sizeof block, file.get())) text.append(block, got);
    if (std::ferror(file.get())) unreadable(path, errno);
    if (text.empty())
        throw IoError("io.empty", path.string(), "", "the file is empty", "write the cloud again");
    if (has_wide_byte_order_mark(text)) throw IoError("io.format", path.string(), "", wide_text_cause, wide_text_remedy);
    return text;
}

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
        // from_chars does not say which way; a negative exponent tells.
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
    } else {  // separators of thousands
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
