// UTF-8: its characters, and what of a text can be shown.
#include "dsc/text/utf8.hpp"

namespace dsc::text {
namespace {

unsigned char byte_at(std::string_view text, std::size_t index) {
    return static_cast<unsigned char>(text[index]);
}
bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }
bool is_control(unsigned char byte) { return byte < 0x20U || byte == 0x7fU; }
bool is_tab_or_line_end(unsigned char byte) { return byte == '\n' || byte == '\t' || byte == '\r'; }

}  // namespace

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

std::size_t character_count(std::string_view text) {
    std::size_t count = 0;
    for (const char c : text) count += starts_character(c) ? 1 : 0;
    return count;
}

std::string_view first_characters(std::string_view text, std::size_t most) {
    std::size_t end = 0;
    for (std::size_t characters = 0; end < text.size(); ++end) {
        if (starts_character(text[end]) && characters++ == most) break;
    }
    return text.substr(0, end);
}

std::optional<std::size_t> first_non_text(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char byte = byte_at(text, i);
        const std::size_t length = character_length(text, i);
        if (length == 0 || (is_control(byte) && !is_tab_or_line_end(byte))) return i;
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

std::string printable(std::string_view text, char control) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text, i);
        const unsigned char byte = byte_at(text, i);
        if (length == 0)
            out += '?';
        else if (length == 1 && is_control(byte))
            out += is_tab_or_line_end(byte) ? ' ' : control;
        else
            out += text.substr(i, length);
        i += length == 0 ? 1 : length;
    }
    return out;
}

}  // namespace dsc::text
