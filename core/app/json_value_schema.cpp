// Writes the JSON Schema of fields and maps.
#include <limits>

#include "config_json.hpp"
#include "json_schema.hpp"

namespace dsc::app {
namespace {

using config::Field;
using config::FieldType;
using nlohmann::ordered_json;

/// The tighter of the declared bound and the range of the C++ member.
void add_bounds(const Field& field, ordered_json& schema) {
    const bool integer = schema["type"] == "integer";
    const bool low_declared =
        field.minimum && (!integer || field.minimum->value >= double(field.storage_min));
    const bool high_declared =
        field.maximum && (!integer || field.maximum->value <= double(field.storage_max));
    if (low_declared) {
        schema[field.minimum->open ? "exclusiveMinimum" : "minimum"] =
            number_json(field.minimum->value);
    } else if (integer) {
        schema["minimum"] = field.storage_min;
    }
    if (high_declared) {
        schema[field.maximum->open ? "exclusiveMaximum" : "maximum"] =
            number_json(field.maximum->value);
    } else if (integer) {
        schema["maximum"] = field.storage_max;
    }
}

ordered_json number_schema(const Field& field, const char* type) {
    ordered_json schema = {{"type", type}};
    add_bounds(field, schema);
    return schema;
}

/// Text that may also come from a variable, whose value only the program knows. `values` comes
/// last, so that an editor completes them.
ordered_json choice_schema(const Field& field) {
    ordered_json values = field.choices;
    if (field.optional) values.push_back(nullptr);
    return {{"if", reference(variable_definition())}, {"else", {{"enum", values}}}};
}

/// A pattern that matches a character in upper and lower case.
std::string either_case(char c) {
    if (c == '.') return "\\.";
    if (c < 'a' || c > 'z') return {c};
    return std::string("[") + c + static_cast<char>(c - 'a' + 'A') + "]";
}

/// A pattern for the end of a file name, or for a variable that may contain it.
ordered_json file_schema(const Field& field) {
    ordered_json schema = {{"type", "string"}};
    const bool may_be_empty =
        field.default_value.is_string() && field.default_value.as_string().empty();
    if (field.extensions.empty()) {
        if (!may_be_empty) schema["minLength"] = 1;
        return schema;
    }
    std::string pattern;
    for (const std::string& extension : field.extensions) {
        if (!pattern.empty()) pattern += "|";
        for (const char c : extension) pattern += either_case(c);
    }
    schema["pattern"] = "(" + pattern + ")$|\\$\\{" + (may_be_empty ? "|^$" : "");
    return schema;
}

ordered_json list_schema(const Field& field, ordered_json items) {
    ordered_json schema = {{"type", "array"}, {"items", std::move(items)}};
    const bool vector = field.type == FieldType::vec3;
    const std::size_t least = vector ? 3 : field.min_size.value_or(0);
    const std::size_t most =
        vector ? 3 : field.max_size.value_or(std::numeric_limits<std::size_t>::max());
    if (least > 0) schema["minItems"] = least;
    if (most != std::numeric_limits<std::size_t>::max()) schema["maxItems"] = most;
    return schema;
}

ordered_json string_item(const Field& field) {
    if (field.has_tag("or_integers")) return {{"type", {"string", "integer"}}};
    for (const std::string& tag : field.tags) {
        constexpr std::string_view keyed = "or_keyed ";
        if (tag.rfind(keyed, 0) != 0) continue;
        const std::string key = tag.substr(keyed.size());
        return {{"anyOf",
                 {{{"type", "string"}},
                  {{"type", "object"},
                   {"properties", {{key, {{"type", "string"}}}}},
                   {"required", ordered_json::array({key})},
                   {"additionalProperties", false}}}}};
    }
    if (field.choices.empty()) return {{"type", "string"}};
    Field item = field;
    item.optional = false;
    ordered_json schema = choice_schema(item);
    schema["type"] = "string";
    return schema;
}

/// A complete map in a list: its allowed and its required keys.
ordered_json map_item(const config::Schema& object) {
    ordered_json schema = map_schema(object);
    ordered_json needed = required_schema(object);
    if (!needed.empty()) schema["allOf"].push_back(std::move(needed));
    return schema;
}

ordered_json bare_schema(const Field& field) {
    switch (field.type) {
        case FieldType::boolean: return {{"type", "boolean"}};
        case FieldType::integer: return number_schema(field, "integer");
        case FieldType::real: return number_schema(field, "number");
        case FieldType::string: return {{"type", "string"}};
        case FieldType::choice: return choice_schema(field);
        case FieldType::file: return file_schema(field);
        case FieldType::vec3:
        case FieldType::real_list: return list_schema(field, number_schema(field, "number"));
        case FieldType::integer_list: return list_schema(field, number_schema(field, "integer"));
        case FieldType::string_list: return list_schema(field, string_item(field));
        case FieldType::object: return map_schema(*field.object);
        case FieldType::object_list: return list_schema(field, map_item(*field.object));
        case FieldType::strategy:
            return {{"type", "object"}, {"allOf", {reference(kind_definition(field.kind))}}};
        case FieldType::strategy_list:
            return list_schema(field, {{"type", "object"},
                                       {"allOf",
                                        {reference(kind_definition(field.kind)),
                                         reference(required_definition(field.kind))}}});
    }
    return true;
}

/// An old name: the same schema as the new name, but both may not be given.
void add_old_name(const config::Schema& schema, const config::Deprecation& old, ordered_json& map) {
    ordered_json value = value_schema(*schema.find(old.new_name));
    value["description"] = "Old name of '" + old.new_name + "'.";
    value["deprecated"] = true;
    value["deprecationMessage"] = "now called '" + old.new_name + "'";
    value["doNotSuggest"] = true;
    map["properties"][old.old_name] = std::move(value);
    map["allOf"].push_back({{"if", {{"required", {old.new_name}}}},
                            {"then", {{"properties", {{old.old_name, false}}}}}});
}

/// Whether the field must be given although it has defaults, because something inside it is
/// required.
bool is_needed(const Field& field) {
    if (field.required) return true;
    return field.type == FieldType::object && !field.optional &&
           !required_schema(*field.object).empty();
}

/// `{"required": [name]}`, or the same with one of the old names.
void add_required(const config::Schema& schema, const std::string& name, ordered_json& needed) {
    ordered_json ways = ordered_json::array({{{"required", {name}}}});
    for (const config::Deprecation& old : schema.deprecations()) {
        if (old.new_name == name) ways.push_back({{"required", {old.old_name}}});
    }
    if (ways.size() == 1) {
        needed["required"].push_back(name);
    } else {
        needed["allOf"].push_back({{"anyOf", std::move(ways)}});
    }
}

}  // namespace

ordered_json value_schema(const Field& field) {
    std::string description = doc_text(field);
    if (field.object && !field.object->checks().empty())
        description += " " + conditions_text(*field.object);
    ordered_json schema = {{"description", description}};
    schema.update(bare_schema(field));
    // An object without a value has its defaults.
    const bool may_be_null = field.optional || field.type == FieldType::object;
    if (may_be_null && schema.contains("type")) schema["type"] = {schema["type"], "null"};
    if (!field.default_value.is_null() && field.type != FieldType::object)
        schema["default"] = to_json(field.default_value);
    return schema;
}

ordered_json map_schema(const config::Schema& schema, const std::string& id) {
    ordered_json map = {{"type", "object"}, {"properties", ordered_json::object()}};
    if (!id.empty()) map["properties"]["type"] = {{"const", id}};
    for (const Field& field : schema.fields()) map["properties"][field.name] = value_schema(field);
    for (const config::Deprecation& old : schema.deprecations()) add_old_name(schema, old, map);
    map["additionalProperties"] = false;
    return map;
}

ordered_json required_schema(const config::Schema& schema) {
    ordered_json needed = ordered_json::object();
    for (const Field& field : schema.fields()) {
        if (is_needed(field)) add_required(schema, field.name, needed);
        if (field.type == FieldType::strategy)
            needed["properties"][field.name] = reference(required_definition(field.kind));
        if (field.type != FieldType::object) continue;
        ordered_json below = required_schema(*field.object);
        if (below.empty()) continue;
        if (!field.optional) below["type"] = "object";
        needed["properties"][field.name] = std::move(below);
    }
    return needed;
}

std::string conditions_text(const config::Schema& schema) {
    std::string text;
    for (const config::CrossCheck& check : schema.checks())
        text += (text.empty() ? "Also checked: " : "; ") + check.message;
    return text.empty() ? "" : text + ".";
}

}  // namespace dsc::app
