// Applies the overrides of the command line and the values of a sweep to a tree.
#include "dsc/config/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/config/diagnostics.hpp>
#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

#include "config/scalar.hpp"

namespace dsc::config {
namespace {

constexpr const char* code = "config.override";

bool is_key_character(char c) {
    return c == '_' || c == '-' || text::is_digit(c) || text::is_letter(c);
}

/// The parts of `a.0.b`; empty if it is not a dotted path.
std::vector<std::string> split(std::string_view path) {
    std::vector<std::string> parts;
    while (true) {
        const std::size_t dot = path.find('.');
        const std::string_view part = path.substr(0, dot);
        if (part.empty() || !std::all_of(part.begin(), part.end(), is_key_character)) return {};
        parts.emplace_back(part);
        if (dot == std::string_view::npos) return parts;
        path.remove_prefix(dot + 1);
    }
}

/// Puts a value into a tree.
class Placement {
public:
    /// `what` is the beginning of every message, `key` is the place of the path.
    Placement(std::string what, SourcePosition key)
        : what_(std::move(what)), key_(std::move(key)) {}

    [[noreturn]] void refuse(const std::string& message, const std::string& hint) const {
        fail(code, key_, what_ + message, hint);
    }

    ConfigNode set(const ConfigNode& node, const std::vector<std::string>& parts,
                   const ConfigNode& value, std::size_t depth = 0,
                   const std::string& path = "") const {
        if (depth == parts.size()) return value;
        const std::string& part = parts[depth];
        const std::string inner = join_path(path, part);
        if (node.is_list()) {
            const std::size_t index = item_index(node, part, path);
            return node.with_item(index, set(node.items()[index], parts, value, depth + 1, inner));
        }
        if (!node.is_map() && !node.is_null()) {
            refuse("'" + path + "' is " + std::string(type_name(node.type())) +
                       "; it has no key '" + part + "'",
                   "");
        }
        const ConfigNode* old = node.find(part);
        return node.with(
            part, set(old ? *old : ConfigNode().placed(key_), parts, value, depth + 1, inner),
            key_);
    }

private:
    std::size_t item_index(const ConfigNode& list, const std::string& part,
                           const std::string& path) const {
        std::size_t index = 0;
        const char* end = part.data() + part.size();
        const auto parsed = std::from_chars(part.data(), end, index);
        if (parsed.ec != std::errc() || parsed.ptr != end || index >= list.size()) {
            refuse(fmt::format("'{}' is a list of {}; it has no item '{}'", path,
                               text::counted(list.size(), "item"), part),
                   list.size() == 0
                       ? "write " + path + "=[...]"
                       : "items are numbered from 0 to " + std::to_string(list.size() - 1));
        }
        return index;
    }

    std::string what_;
    SourcePosition key_;
};

/// Applies one override.
class Override {
public:
    Override(const std::string& text, const YamlOptions& options)
        : source_(std::make_shared<const SourceText>(
              SourceText{SourceText::Kind::command_line, "command line", text})),
          options_(options) {}

    ConfigNode apply(const ConfigNode& root) {
        const std::string& text = source_->text;
        const Placement placement(
            "malformed override: ",
            {source_, 1, 1, static_cast<int>(text::character_count(source_->text))});
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos)
            placement.refuse("no '=' in it", "write path.to.key=value");
        if (text[0] == '+' || text[0] == '~') {
            placement.refuse(std::string("it starts with '") + text[0] + "'",
                             "write path.to.key=value; every key of the schema is allowed");
        }
        const std::vector<std::string> parts = split(std::string_view(text).substr(0, equals));
        if (parts.empty()) {
            placement.refuse(text::in_quotes(text.substr(0, equals)) + " is not a dotted path",
                             "write path.to.key=value");
        }
        if (parts.size() > options_.max_depth) placement.refuse("its path is too long", "");
        if (text::first_non_text(text)) placement.refuse("it contains bytes that are not text", "");
        if (text.find_first_of("\r\n") != std::string::npos)
            placement.refuse("it has more than one line", "");
        const ConfigNode value = parse_value(source_, equals + 1, options_);
        const bool lost = value.is_null() && !is_null_text(text.substr(equals + 1));
        if (lost) placement.refuse("its value is a comment", "put a value with '#' in quotes");
        return placement.set(root, parts, value);
    }

private:
    std::shared_ptr<const SourceText> source_;
    const YamlOptions& options_;
};

}  // namespace

ConfigNode apply_overrides(const ConfigNode& root, std::span<const std::string> overrides,
                           const YamlOptions& options) {
    ConfigNode tree = root;
    std::string faults;
    std::size_t count = 0;
    for (const std::string& text : overrides) {
        try {
            tree = Override(text, options).apply(tree);
        } catch (const ConfigError& error) {
            // Each message ends with its own summary; the summary at the end counts all faults.
            const std::string_view message = error.what();
            faults += message.substr(0, message.rfind('\n') + 1);
            ++count;
        }
    }
    if (count > 0) {
        throw ConfigError(code, faults + text::counted(count, "error") + "; nothing was run");
    }
    return tree;
}

ConfigNode with_value(const ConfigNode& root, const std::string& path, const ConfigNode& value,
                      const SourcePosition& key) {
    const Placement placement("", key);
    const std::vector<std::string> parts = split(path);
    if (parts.empty())
        placement.refuse(text::in_quotes(path) + " is not a dotted path",
                         "write path.to.key: value");
    if (parts.size() > YamlOptions{}.max_depth) placement.refuse("its path is too long", "");
    return placement.set(root, parts, value);
}

}  // namespace dsc::config
