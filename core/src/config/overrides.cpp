#include <algorithm>
#include <charconv>
#include <dsc/base/error.hpp>
#include <dsc/config/diagnostics.hpp>
#include <dsc/config/overrides.hpp>
#include <string_view>
#include <vector>

#include "config/scalar.hpp"
#include "config/text.hpp"

namespace dsc::config {
namespace {

constexpr const char* code = "config.override";

bool is_key_character(char c) {
    return c == '_' || c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// The parts of `a.0.b`; empty where it is no dotted path.
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

/// One override on its way into the tree.
class Override {
public:
    Override(const std::string& text, const YamlOptions& options)
        : source_(std::make_shared<const SourceText>(
              SourceText{SourceText::Kind::command_line, "command line", text})),
          options_(options) {}

    ConfigNode apply(const ConfigNode& root) {
        const std::string& text = source_->text;
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos) refuse("no '=' in it", "write path.to.key=value");
        if (text[0] == '+' || text[0] == '~') {
            refuse(std::string("it starts with '") + text[0] + "'",
                   "write path.to.key=value; any key of the schema may be given");
        }
        parts_ = split(std::string_view(text).substr(0, equals));
        if (parts_.empty()) {
            refuse(quoted_text(text.substr(0, equals)) + " is no dotted path", "write path.to.key=value");
        }
        if (parts_.size() > options_.max_depth) refuse("its path is too long", "");
        if (first_non_text(text)) refuse("it holds bytes that are no text", "");
        if (text.find_first_of("\r\n") != std::string::npos) refuse("it has more than one line", "");
        value_ = parse_value(source_, equals + 1, options_);
        const bool lost = value_.is_null() && !is_null_text(text.substr(equals + 1));
        if (lost) refuse("its value is a comment", "put a value with '#' in quotes");
        return set(root, 0, "");
    }

private:
    [[noreturn]] void refuse(const std::string& message, const std::string& hint) const {
        fail(code, position(), "malformed override: " + message, hint);
    }

    SourcePosition position() const {
        return {source_, 1, 1, static_cast<int>(character_count(source_->text))};
    }

    ConfigNode set(const ConfigNode& node, std::size_t depth, const std::string& path) const {
        if (depth == parts_.size()) return value_;
        const std::string& part = parts_[depth];
        const std::string inner = join_path(path, part);
        if (node.is_list()) {
            std::size_t index = 0;
            const char* end = part.data() + part.size();
            const auto parsed = std::from_chars(part.data(), end, index);
            if (parsed.ec != std::errc() || parsed.ptr != end || index >= node.size()) {
                refuse("'" + path + "' is a list of " + std::to_string(node.size()) + ", it has no item '" +
                           part + "'",
                       node.size() == 0 ? "write " + path + "=[...]"
                                        : "items are numbered from 0 to " + std::to_string(node.size() - 1));
            }
            return node.with_item(index, set(node.items()[index], depth + 1, inner));
        }
        if (!node.is_map() && !node.is_null()) {
            refuse(
                "'" + path + "' is " + std::string(type_name(node.type())) + ", it has no key '" + part + "'",
                "");
        }
        const ConfigNode* old = node.find(part);
        return node.with(part, set(old ? *old : ConfigNode().placed(position()), depth + 1, inner),
                         position());
    }

    std::shared_ptr<const SourceText> source_;
    const YamlOptions& options_;
    std::vector<std::string> parts_;
    ConfigNode value_;
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
            // Each ends with a summary of its own; the one at the end counts them all.
            const std::string_view message = error.what();
            faults += message.substr(0, message.rfind('\n') + 1);
            ++count;
        }
    }
    if (count > 0) {
        throw ConfigError(
            code, faults + std::to_string(count) + (count == 1 ? " error" : " errors") + "; nothing was run");
    }
    return tree;
}

}  // namespace dsc::config
