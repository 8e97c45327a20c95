// Words of texts and messages.
#include "dsc/text/words.hpp"

#include <algorithm>

#include <dsc/text/utf8.hpp>

namespace dsc::text {
namespace {

bool is_snake(char c) { return is_lower(c) || is_digit(c) || c == '_'; }
bool is_word_part(char c) { return is_letter(c) || is_digit(c) || c == '_'; }

}  // namespace

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

std::size_t find_word(std::string_view text, std::string_view word) {
    const auto is_part = [&](std::size_t at) { return at < text.size() && is_word_part(text[at]); };
    std::size_t at = text.find(word);
    while (at != std::string_view::npos &&
           ((at > 0 && is_part(at - 1)) || is_part(at + word.size())))
        at = text.find(word, at + 1);
    return at;
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return out;
}

std::string lower_case_extension(const std::filesystem::path& file) {
    return lower_case(file.extension().string());
}

bool is_snake_case(std::string_view name) {
    return !name.empty() && std::all_of(name.begin(), name.end(), is_snake);
}

bool is_identifier(std::string_view name) {
    return !name.empty() && !is_digit(name.front()) &&
           std::all_of(name.begin(), name.end(), is_word_part);
}

bool is_id(std::string_view name) { return is_snake_case(name) && is_lower(name.front()); }

std::string in_quotes(std::string_view text) {
    constexpr std::size_t longest = 60;
    const std::string_view begin = first_characters(text, longest);
    std::string out = "'" + printable(begin, '?');
    if (begin.size() < text.size()) out += "...";
    return out += '\'';
}

std::string counted(std::uint64_t count, std::string_view noun, std::string_view many) {
    std::string out = std::to_string(count);
    out.append(" ").append(count == 1 || many.empty() ? noun : many);
    if (count != 1 && many.empty()) out += 's';
    return out;
}

}  // namespace dsc::text
