// The fields of a map: their texts, and the check of a declaration.
#include "dsc/config/schema.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/core.h>

#include <dsc/config/field_text.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/text/words.hpp>

#include "config/field_value.hpp"

namespace dsc::config {
namespace {

bool is_list_type(FieldType type) {
    switch (type) {
        case FieldType::vec3:
        case FieldType::integer_list:
        case FieldType::real_list:
        case FieldType::string_list:
        case FieldType::object_list:
        case FieldType::strategy_list: return true;
        default: return false;
    }
}

bool is_numeric_type(FieldType type) {
    switch (type) {
        case FieldType::integer:
        case FieldType::real:
        case FieldType::vec3:
        case FieldType::integer_list:
        case FieldType::real_list: return true;
        default: return false;
    }
}

bool has_object(FieldType type) {
    return type == FieldType::object || type == FieldType::object_list;
}
bool has_kind(FieldType type) {
    return type == FieldType::strategy || type == FieldType::strategy_list;
}

std::string short_text(const ConfigNode& node) {
    if (node.is_string()) return node.as_string().empty() ? "''" : node.as_string();
    if (node.is_map()) {
        const ConfigNode* type = node.find("type");
        return type ? type->as_string() : "as below";
    }
    if (node.is_list()) {
        std::vector<std::string> items;
        for (const ConfigNode& item : node.items()) items.push_back(short_text(item));
        return "[" + join(items) + "]";
    }
    return node.is_number() ? number_text(node) : value_text(node);
}

/// "list of strings out of obj | ply".
std::string held_text(const Field& field) {
    if (field.type == FieldType::choice) return "one of " + join(field.choices, " | ");
    if (field.type == FieldType::strategy) return field.kind + " strategy";
    if (field.type == FieldType::strategy_list) return "list of " + field.kind + " strategies";
    std::string out(type_name(field.type));
    if (!field.choices.empty()) out += " out of " + join(field.choices, " | ");
    if (!field.extensions.empty()) out += " (" + join(field.extensions, " ") + ")";
    return out;
}

/// "1 to 4 items"; empty if any number is allowed.
std::string size_text(const Field& field) {
    const std::size_t least = field.min_size.value_or(0);
    const std::size_t most = field.max_size.value_or(std::numeric_limits<std::size_t>::max());
    if (least == most) return text::counted(least, "item");
    if (most == std::numeric_limits<std::size_t>::max())
        return least == 0 ? "" : "at least " + text::counted(least, "item");
    return least == 0 ? "at most " + text::counted(most, "item")
                      : fmt::format("{} to {}", least, text::counted(most, "item"));
}

/// ", 1 to 4 items, (0, 1]": the bounds of size and value.
std::string limits_text(const Field& field) {
    std::string out;
    if (const std::string size = size_text(field); !size.empty()) out += ", " + size;
    if (const std::string range = field.range_text(); !range.empty()) out += ", " + range;
    return out;
}

/// The faults of one field, without its place.
std::vector<std::string> field_problems(const Field& field) {
    std::vector<std::string> faults;
    if (!text::is_identifier(field.name))
        faults.emplace_back("has a name that is not an identifier");
    if (field.doc.empty()) faults.emplace_back("has no doc");
    const bool bounded = field.minimum || field.maximum;
    if (bounded && !is_numeric_type(field.type))
        faults.emplace_back("has a range but is not a number");
    if (field.minimum && field.maximum && field.minimum->value > field.maximum->value) {
        faults.emplace_back("has an empty range");
    }
    if ((field.min_size || field.max_size) && !is_list_type(field.type)) {
        faults.emplace_back("has a size but is not a list");
    }
    if (field.type == FieldType::choice && field.choices.empty())
        faults.emplace_back("has no choices");
    if (!field.choices.empty() && field.type != FieldType::choice &&
        field.type != FieldType::string_list) {
        faults.emplace_back("has choices but is not a choice");
    }
    if (!field.extensions.empty() && field.type != FieldType::file) {
        faults.emplace_back("has extensions but is not a file");
    }
    if (has_object(field.type) && !field.object) faults.emplace_back("has no schema");
    if (has_kind(field.type) && field.kind.empty())
        faults.emplace_back("names no kind of strategy");
    if (field.required && field.optional) faults.emplace_back("is both required and optional");
    const ConfigNode& value = field.default_value;
    if (field.required || (field.optional && value.is_null()) || !is_plain_field(field.type))
        return faults;
    if (faults.empty()) {
        Diagnostics diagnostics;
        resolve_value(field, value, field.name, {}, diagnostics);
        for (const Diagnostic& d : diagnostics.all())
            faults.push_back("has a bad default: " + d.message);
    }
    return faults;
}

}  // namespace

std::string_view type_name(FieldType type) {
    switch (type) {
        case FieldType::boolean: return "boolean";
        case FieldType::integer: return "integer";
        case FieldType::real: return "real";
        case FieldType::string: return "string";
        case FieldType::choice: return "choice";
        case FieldType::file: return "file";
        case FieldType::vec3: return "vector of 3 reals";
        case FieldType::integer_list: return "list of integers";
        case FieldType::real_list: return "list of reals";
        case FieldType::string_list: return "list of strings";
        case FieldType::object: return "map";
        case FieldType::object_list: return "list of maps";
        case FieldType::strategy: return "strategy";
        case FieldType::strategy_list: return "list of strategies";
    }
    return "string";
}

bool Field::has_tag(std::string_view tag) const {
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

const ConfigNode& Field::text_of(const ConfigNode& item) const {
    if (!item.is_map() || item.size() != 1) return item;
    const ConfigEntry& entry = item.entries().front();
    return has_tag("or_keyed " + entry.key) ? entry.value : item;
}

std::string Field::range_text() const {
    const auto text = [&](const Bound& bound) { return bound_text(*this, bound.value); };
    if (minimum && maximum && minimum->value == maximum->value) return "exactly " + text(*minimum);
    if (minimum && maximum) {
        return (minimum->open ? "(" : "[") + text(*minimum) + ", " + text(*maximum) +
               (maximum->open ? ")" : "]");
    }
    if (minimum) return (minimum->open ? "above " : "at least ") + text(*minimum);
    if (maximum) return (maximum->open ? "below " : "at most ") + text(*maximum);
    return {};
}

std::string Field::summary() const {
    std::string out = held_text(*this);
    if (!unit.empty() && unit != "dimensionless") out += " in " + unit;
    out += limits_text(*this);
    if (required) return out + ", required";
    if (optional && default_value.is_null()) return out + ", optional";
    if (type != FieldType::object) out += ", default " + short_text(default_value);
    return out;
}

std::string type_text(const Field& field) { return held_text(field) + limits_text(field); }

std::string default_text(const Field& field) {
    if (field.required) return "required";
    if (field.optional && field.default_value.is_null()) return "unset";
    return field.type == FieldType::object ? "" : short_text(field.default_value);
}

std::size_t Schema::add(Field field) {
    fields_.push_back(std::move(field));
    return fields_.size() - 1;
}

void Schema::deprecate(std::string old_name, std::string new_name) {
    deprecations_.push_back({std::move(old_name), std::move(new_name)});
}

void Schema::check(CrossCheck check) { checks_.push_back(std::move(check)); }

const Field* Schema::find(std::string_view name) const noexcept {
    for (const Field& field : fields_) {
        if (field.name == name) return &field;
    }
    return nullptr;
}

std::vector<std::string> Schema::names() const {
    std::vector<std::string> out;
    for (const Field& field : fields_) out.push_back(field.name);
    return out;
}

std::vector<std::string> Schema::problems(bool of_strategy) const {
    std::vector<std::string> out;
    std::set<std::string> seen;
    for (const Field& field : fields_) {
        const std::string subject = "parameter '" + field.name + "' ";
        if (!seen.insert(field.name).second) out.push_back(subject + "is declared twice");
        if (of_strategy && field.name == "type")
            out.push_back(subject + "has the name 'type', which selects the strategy");
        for (const std::string& fault : field_problems(field)) out.push_back(subject + fault);
        if (!field.object) continue;
        for (const std::string& inner : field.object->problems())
            out.push_back("in '" + field.name + "': " + inner);
    }
    for (const Deprecation& d : deprecations_) {
        if (!find(d.new_name))
            out.push_back("'" + d.old_name + "' is an old name of '" + d.new_name +
                          "', which is not a parameter");
        if (find(d.old_name))
            out.push_back("'" + d.old_name + "' is both a parameter and an old name");
    }
    for (const CrossCheck& c : checks_) {
        if (c.message.empty()) out.emplace_back("a cross check has no message");
    }
    return out;
}

}  // namespace dsc::config
