// Checks and converts the value of one field.
#include "config/field_value.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <fmt/core.h>

#include <dsc/config/spelling.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/text/words.hpp>

#include "config/scalar.hpp"
#include "config/variables.hpp"

namespace dsc::config {
namespace {

/// Checks one value.
class FieldCheck {
public:
    FieldCheck(const Field& field, const SourcePosition& fallback, Diagnostics& diagnostics)
        : field_(field), fallback_(fallback), diagnostics_(diagnostics) {}

    ConfigNode boolean(const ConfigNode& node, const std::string& path) {
        if (node.is_boolean()) return node;
        return wrong_type(node, path, "true or false", text_hint(node, boolean_hint));
    }

    ConfigNode integer(const ConfigNode& node, const std::string& path) {
        constexpr double exact_to = 9007199254740992.0;  // 2^53
        const bool exact =
            node.is_integer() || (node.is_real() && std::abs(node.as_real()) <= exact_to &&
                                  std::trunc(node.as_real()) == node.as_real());
        if (!exact) {
            return wrong_type(node, path, "an integer", text_hint(node, number_hint));
        }
        const std::int64_t value = node.as_integer();
        if (within(static_cast<double>(value), std::to_string(value), node, path) &&
            (value < field_.storage_min || value > field_.storage_max)) {
            range_error(std::to_string(value), node, path,
                        value < field_.storage_min
                            ? "is below the minimum " + std::to_string(field_.storage_min)
                            : "is above the maximum " + std::to_string(field_.storage_max));
        }
        return ConfigNode(value).placed(node.position()).with_path(path);
    }

    ConfigNode real(const ConfigNode& node, const std::string& path) {
        if (!node.is_number()) {
            return wrong_type(node, path, "a number", text_hint(node, number_hint));
        }
        within(node.as_real(), number_text(node), node, path);
        return ConfigNode(node.as_real()).placed(node.position()).with_path(path);
    }

    ConfigNode string(const ConfigNode& item, const std::string& path) {
        const ConfigNode& node = field_.text_of(item);
        if (node.is_integer() && field_.has_tag("or_integers")) {
            return ConfigNode(std::to_string(node.as_integer()))
                .placed(node.position())
                .with_path(path);
        }
        if (!node.is_string()) {
            const bool scalar = !node.is_list() && !node.is_map() && !node.is_null();
            const bool any_text = scalar && field_.choices.empty();
            return wrong_type(node, path, "a string", any_text ? "put it in quotes" : "");
        }
        if (!field_.choices.empty()) check_choice(node, path);
        return node;
    }

    /// The name is relative to the folder of the file that contains it; for the command line and
    /// for code, to the working folder.
    ConfigNode file(const ConfigNode& node, const std::string& path) {
        namespace fs = std::filesystem;
        if (!node.is_string()) return wrong_type(node, path, "the name of a file", "");
        if (node.as_string().empty()) {
            if (field_.default_value != node) {
                diagnostics_.error("config.file", place(node),
                                   "'" + path + "' is an empty name of a file");
            }
            return node;
        }
        const fs::path given(node.as_string());
        check_extension(given, node, path);
        const SourcePosition& position = node.position();
        const bool in_file = position.known() && !position.from_command_line();
        const fs::path folder =
            in_file ? fs::path(position.source->name).parent_path() : fs::path();
        const std::string resolved = fs::absolute(folder / given).lexically_normal().string();
        return ConfigNode(resolved).placed(position, node.quoted()).with_path(path);
    }

    template <class Item>
    ConfigNode list(const ConfigNode& node, const std::string& path, const std::string& wanted,
                    Item item) {
        if (!node.is_list())
            return wrong_type(node, path, wanted,
                              node.is_map() ? "" : "write it in brackets: [...]");
        check_size(node, path);
        std::vector<ConfigNode> items;
        for (std::size_t i = 0; i < node.size(); ++i) {
            items.push_back(item(node.items()[i], join_path(path, std::to_string(i))));
        }
        return ConfigNode::list(std::move(items)).placed(node.position()).with_path(path);
    }

private:
    const SourcePosition& place(const ConfigNode& node) const {
        return node.position().known() ? node.position() : fallback_;
    }

    /// Remedy for text where a number or a boolean is expected.
    static std::string text_hint(const ConfigNode& node, std::string (*hint)(std::string_view)) {
        if (!node.is_string()) return {};
        return holds_variable(node.position())
                   ? "a variable gives text; write the value itself, or override it with KEY=VALUE"
                   : hint(node.as_string());
    }

    ConfigNode wrong_type(const ConfigNode& node, const std::string& path,
                          const std::string& wanted, const std::string& hint) {
        diagnostics_.error("config.wrong_type", place(node),
                           "'" + path + "' must be " + wanted + ", not " + value_text(node),
                           hint.empty() ? "accepted: " + field_.summary() : hint);
        return node;
    }

    void range_error(const std::string& value, const ConfigNode& node, const std::string& path,
                     const std::string& fault) {
        diagnostics_.error("config.out_of_range", place(node),
                           "'" + path + "': " + value + " " + fault,
                           "accepted: " + field_.summary());
    }

    bool within(double value, const std::string& text, const ConfigNode& node,
                const std::string& path) {
        const auto bound_text = [&](double bound) { return config::bound_text(field_, bound); };
        const std::optional<Bound>& low = field_.minimum;
        const std::optional<Bound>& high = field_.maximum;
        std::string fault;
        if (low && value < low->value) {
            fault = "is below the minimum " + bound_text(low->value);
        } else if (low && low->open && value == low->value) {
            fault = "is not above " + bound_text(low->value);
        } else if (high && value > high->value) {
            fault = "is above the maximum " + bound_text(high->value);
        } else if (high && high->open && value == high->value) {
            fault = "is not below " + bound_text(high->value);
        }
        if (fault.empty()) return true;
        range_error(text, node, path, fault);
        return false;
    }

    void check_choice(const ConfigNode& node, const std::string& path) {
        const std::string& value = node.as_string();
        if (std::find(field_.choices.begin(), field_.choices.end(), value) != field_.choices.end())
            return;
        const auto near = closest(value, field_.choices);
        diagnostics_.error(
            "config.bad_choice", place(node),
            "'" + path + "': " + text::in_quotes(value) + " is not one of " + join(field_.choices),
            near ? "did you mean '" + *near + "'?" : "");
    }

    void check_extension(const std::filesystem::path& file, const ConfigNode& node,
                         const std::string& path) {
        if (field_.extensions.empty()) return;
        std::string extension = file.extension().string();
        for (char& c : extension) {
            if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
        }
        const auto& accepted = field_.extensions;
        if (std::find(accepted.begin(), accepted.end(), extension) != accepted.end()) return;
        diagnostics_.error("config.file", place(node),
                           "'" + path + "': " + text::in_quotes(file.string()) +
                               " cannot be used here; the file's name must end in " +
                               join(accepted, " or "));
    }

    void check_size(const ConfigNode& node, const std::string& path) {
        const std::size_t size = node.size();
        const bool vector = field_.type == FieldType::vec3;
        const std::size_t least = vector ? 3 : field_.min_size.value_or(0);
        const std::size_t most =
            vector ? 3 : field_.max_size.value_or(std::numeric_limits<std::size_t>::max());
        if (size >= least && size <= most) return;
        std::string wanted;
        if (least == most) {
            wanted = "exactly " + text::counted(least, "item");
        } else if (size < least) {
            wanted = "at least " + text::counted(least, "item");
        } else {
            wanted = "at most " + text::counted(most, "item");
        }
        diagnostics_.error("config.list_size", place(node),
                           fmt::format("'{}' must have {}, not {}", path, wanted, size),
                           "accepted: " + field_.summary());
    }

    const Field& field_;
    const SourcePosition& fallback_;
    Diagnostics& diagnostics_;
};

}  // namespace

bool is_plain_field(FieldType type) {
    switch (type) {
        case FieldType::object:
        case FieldType::object_list:
        case FieldType::strategy:
        case FieldType::strategy_list: return false;
        default: return true;
    }
}

std::string number_text(const ConfigNode& node) {
    if (node.is_integer()) return std::to_string(node.as_integer());
    std::string text = real_text(node.as_real());
    if (text.size() > 2 && text.compare(text.size() - 2, 2, ".0") == 0)
        text.resize(text.size() - 2);
    return text;
}

std::string bound_text(const Field& field, double bound) {
    const bool integer = field.type == FieldType::integer || field.type == FieldType::integer_list;
    return number_text(integer ? ConfigNode(static_cast<std::int64_t>(bound)) : ConfigNode(bound));
}

std::string value_text(const ConfigNode& node) {
    switch (node.type()) {
        case NodeType::null: return "an empty value";
        case NodeType::boolean: return node.as_boolean() ? "true" : "false";
        case NodeType::integer: return std::to_string(node.as_integer());
        case NodeType::real: return real_text(node.as_real());
        case NodeType::string: return "the string " + text::in_quotes(node.as_string());
        default: return std::string(type_name(node.type()));
    }
}

ConfigNode resolve_value(const Field& field, const ConfigNode& node, const std::string& path,
                         const SourcePosition& fallback, Diagnostics& diagnostics) {
    FieldCheck check(field, fallback, diagnostics);
    const auto integer = [&](const ConfigNode& item, const std::string& at) {
        return check.integer(item, at);
    };
    const auto real = [&](const ConfigNode& item, const std::string& at) {
        return check.real(item, at);
    };
    const auto string = [&](const ConfigNode& item, const std::string& at) {
        return check.string(item, at);
    };
    switch (field.type) {
        case FieldType::boolean: return check.boolean(node, path);
        case FieldType::integer: return check.integer(node, path);
        case FieldType::real: return check.real(node, path);
        case FieldType::file: return check.file(node, path);
        case FieldType::vec3: return check.list(node, path, "a list of three numbers", real);
        case FieldType::integer_list: return check.list(node, path, "a list of integers", integer);
        case FieldType::real_list: return check.list(node, path, "a list of numbers", real);
        case FieldType::string_list: return check.list(node, path, "a list of strings", string);
        default: return check.string(node, path);
    }
}

}  // namespace dsc::config
