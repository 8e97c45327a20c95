// Small helpers on UTF-8 text.
#include "config/text.hpp"

namespace dsc::config {
namespace {

unsigned char byte_at(std::string_view text, std::size_t index) {
    return static_cast<unsigned char>(text[index]);
}

/// Length of the well-formed character at `begin`; 0 if there is none.
std::size_t character_length(std::string_view text, std::size_t begin) {
    const unsigned lead = byte_at(text, begin);
    if (lead < 0x80U) return 1;
    const std::size_t length = lead >= 0xf0U ? 4 : lead >= 0xe0U ? 3 : 2;
    if (lead < 0xc2U || lead > 0xf4U || begin + length > text.size()) return 0;
    unsigned code = lead & (0x7fU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        const unsigned next = byte_at(text, begin + i);
        if ((next & 0xc0U) != 0x80U) return 0;
        code = (code << 6U) | (next & 0x3fU);
    }
    const bool overlong = (length == 3 && code < 0x800U) || (length == 4 && code < 0x10000U);
    const bool surrogate = code >= 0xd800U && code <= 0xdfffU;
    return overlong || surrogate || code > 0x10ffffU ? 0 : length;
}

bool is_control(unsigned char byte) { return byte < 0x20U || byte == 0x7fU; }

}  // namespace

std::size_t character_count(std::string_view text) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if ((byte_at(text, i) & 0xc0U) != 0x80U) ++count;
    }
    return count;
}

std::optional<std::size_t> first_non_text(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char byte = byte_at(text, i);
        const std::size_t length = character_length(text, i);
        const bool line_end_or_tab = byte == '\n' || byte == '\t' || byte == '\r';
        if (length == 0 || (is_control(byte) && !line_end_or_tab)) return i;
        i += length;
    }
    return std::nullopt;
}

bool is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text, i);
        if (length == 0) return false;
        i += length;
    }
    return true;
}

std::string printable(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text, i);
        if (length == 0) {
            out += '?';
            ++i;
            continue;
        }
        if (length == 1) {
            out += is_control(byte_at(text, i)) ? ' ' : text[i];
        } else {
            out += text.substr(i, length);
        }
        i += length;
    }
    return out;
}

std::string quoted_text(std::string_view text) {
    constexpr std::size_t longest = 60;
    std::size_t end = 0;
    for (std::size_t characters = 0; end < text.size(); ++end) {
        if ((byte_at(text, end) & 0xc0U) != 0x80U && characters++ == longest) break;
    }
    return "'" + printable(text.substr(0, end)) + (end < text.size() ? "..." : "") + "'";
}

std::string items_text(std::size_t count) { return std::to_string(count) + (count == 1 ? " item" : " items"); }

std::size_t find_word(std::string_view text, std::string_view word) {
    const auto is_part = [&](std::size_t at) {
        const char c = at < text.size() ? text[at] : ' ';
        return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    std::size_t at = text.find(word);
    while (at != std::string_view::npos && ((at > 0 && is_part(at - 1)) || is_part(at + word.size())))
        at = text.find(word, at + 1);
    return at;
}

}  // namespace dsc::config
