// Writes a ConfigNode as YAML text that reads back as the same tree.
#include <array>
#include <charconv>
#include <cmath>
#include <string>

#include <dsc/base/error.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

namespace dsc::config {
namespace {

bool is_letter(char c) { return text::is_letter(c) || c == '_'; }

/// Words that some YAML readers do not read as a string.
bool is_special_word(std::string_view text) {
    static constexpr std::array words = {"true", "false", "null", "yes", "no",
                                         "on",   "off",   "y",    "n"};
    const std::string lower = text::lower_case(text);
    for (const char* word : words) {
        if (lower == word) return true;
    }
    return false;
}

bool is_plain_string(std::string_view text) {
    if (text.empty() || (!is_letter(text[0]) && text[0] != '/') || is_special_word(text))
        return false;
    for (const char c : text) {
        const bool harmless =
            is_letter(c) || text::is_digit(c) || c == '.' || c == '/' || c == '-' || c == '+';
        if (!harmless) return false;
    }
    return true;
}

std::string double_quoted(std::string_view text) {
    constexpr const char* digits = "0123456789ABCDEF";
    std::string out = "\"";
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (c == '\n') {
            out += "\\n";
        } else if (c == '\t') {
            out += "\\t";
        } else if (byte < 0x20U || byte == 0x7fU) {
            out += std::string("\\x") + digits[byte >> 4U] + digits[byte & 15U];
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string key_text(const std::string& key) {
    if (!text::is_utf8(key))
        throw ConfigError("config.text", "configuration", "a key is not UTF-8 text",
                          "write keys in UTF-8");
    return is_plain_string(key) ? key : double_quoted(key);
}

/// Characters that would be read as a variable are escaped.
std::string string_text(const ConfigNode& node) {
    std::string escaped;
    const std::string& text = node.as_string();
    if (!text::is_utf8(text)) {
        throw ConfigError("config.text", node.path(), "the value is not UTF-8 text",
                          "write values in UTF-8");
    }
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "${") == 0) escaped += '$';
        escaped += text[i];
    }
    return is_plain_string(escaped) ? escaped : double_quoted(escaped);
}

std::string scalar_text(const ConfigNode& node) {
    switch (node.type()) {
        case NodeType::boolean: return node.as_boolean() ? "true" : "false";
        case NodeType::integer: return std::to_string(node.as_integer());
        case NodeType::real: return real_text(node.as_real());
        case NodeType::string: return string_text(node);
        default: return "null";
    }
}

bool is_scalar(const ConfigNode& node) { return !node.is_list() && !node.is_map(); }

/// Lists of scalars (vectors, formats) stay on one line.
bool is_inline(const ConfigNode& node) {
    if (is_scalar(node) || node.size() == 0) return true;
    if (node.is_map()) return false;
    for (const ConfigNode& item : node.items()) {
        if (!is_scalar(item)) return false;
    }
    return true;
}

std::string inline_text(const ConfigNode& node) {
    if (is_scalar(node)) return scalar_text(node);
    if (node.is_map()) return "{}";
    std::string out = "[";
    for (const ConfigNode& item : node.items()) {
        if (out.size() > 1) out += ", ";
        out += scalar_text(item);
    }
    return out + "]";
}

/// Appends the node with `indent` blanks; `lead` says whether the first line is already indented
/// ("- " before it).
void write(const ConfigNode& node, std::size_t indent, bool lead, std::string& out) {
    if (is_inline(node)) {
        out += std::string(lead ? 0 : indent, ' ') + inline_text(node) + "\n";
        return;
    }
    const auto start_line = [&] {
        if (!lead) out += std::string(indent, ' ');
        lead = false;
    };
    if (node.is_list()) {
        for (const ConfigNode& item : node.items()) {
            start_line();
            out += "- ";
            write(item, indent + 2, true, out);
        }
        return;
    }
    for (const ConfigEntry& entry : node.entries()) {
        start_line();
        out += key_text(entry.key) + ":";
        if (is_inline(entry.value)) {
            out += " " + inline_text(entry.value) + "\n";
        } else {
            out += "\n";
            write(entry.value, indent + 2, false, out);
        }
    }
}

}  // namespace

std::string real_text(double value) {
    if (!std::isfinite(value)) {
        throw ConfigError("config.range", "configuration", "a number is not finite",
                          "use finite numbers");
    }
    const double size = std::abs(value);
    const bool fixed = size == 0 || (size >= 1e-5 && size < 1e15);
    std::array<char, 64> buffer{};
    const auto result =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                      fixed ? std::chars_format::fixed : std::chars_format::scientific);
    std::string text(buffer.data(), result.ptr);
    if (fixed && text.find('.') == std::string::npos) text += ".0";
    return text;
}

std::string flow_text(const ConfigNode& node) {
    if (is_scalar(node)) return scalar_text(node);
    std::string out;
    if (node.is_list()) {
        for (const ConfigNode& item : node.items())
            out += (out.empty() ? "" : ", ") + flow_text(item);
        return "[" + out + "]";
    }
    for (const ConfigEntry& entry : node.entries()) {
        out += (out.empty() ? "" : ", ") + key_text(entry.key) + ": " + flow_text(entry.value);
    }
    return "{" + out + "}";
}

std::string to_yaml(const ConfigNode& node) {
    if (node.find("include")) {
        throw ConfigError("config.include", "configuration",
                          "a map with the key 'include' cannot be written, because it would be "
                          "read as a file name",
                          "rename the key");
    }
    std::string out;
    write(node, 0, false, out);
    return out;
}

}  // namespace dsc::config
