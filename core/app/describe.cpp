#include "describe.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <dsc/config/yaml.hpp>

#include "config_json.hpp"

namespace dsc::app {
namespace {

using config::Field;
using config::FieldType;
using nlohmann::ordered_json;

ordered_json bound(const std::optional<config::Bound>& bound) {
    if (!bound) return nullptr;
    return {{"value", bound->value}, {"open", bound->open}};
}

/// Adds the parameters of a map (under `key`), its conditions and its old names to `json`.
void add_schema(const config::Schema& schema, const char* key, ordered_json& json);

ordered_json fields_json(const config::Schema& schema) {
    ordered_json fields = ordered_json::array();
    for (const Field& field : schema.fields()) {
        ordered_json json = {{"name", field.name},
                             {"type", std::string(config::type_name(field.type))},
                             {"doc", field.doc},
                             {"unit", field.unit},
                             {"required", field.required},
                             {"optional", field.optional},
                             {"default", to_json(field.default_value)}};
        if (field.minimum) json["minimum"] = bound(field.minimum);
        if (field.maximum) json["maximum"] = bound(field.maximum);
        if (field.min_size) json["min_size"] = *field.min_size;
        if (field.max_size && *field.max_size != std::numeric_limits<std::size_t>::max())
            json["max_size"] = *field.max_size;
        if (!field.choices.empty()) json["choices"] = field.choices;
        if (!field.extensions.empty()) json["extensions"] = field.extensions;
        if (!field.kind.empty()) json["kind"] = field.kind;
        if (!field.tags.empty()) json["tags"] = field.tags;
        if (field.object) add_schema(*field.object, "fields", json);
        fields.push_back(std::move(json));
    }
    return fields;
}

void add_schema(const config::Schema& schema, const char* key, ordered_json& json) {
    json[key] = fields_json(schema);
    if (!schema.checks().empty()) {
        ordered_json& checks = json["checks"] = ordered_json::array();
        for (const config::CrossCheck& check : schema.checks()) checks.push_back(check.message);
    }
    if (!schema.deprecations().empty()) {
        ordered_json& old_names = json["deprecated"] = ordered_json::array();
        for (const config::Deprecation& d : schema.deprecations())
            old_names.push_back({{"old_name", d.old_name}, {"new_name", d.new_name}});
    }
}

void schema_text(const config::Schema& schema, const std::string& indent, std::string& text) {
    for (const Field& field : schema.fields()) {
        text += indent + field.name + ": " + field.summary() + "\n";
        text += wrapped(field.doc, indent + "    ");
        if (field.object) schema_text(*field.object, indent + "  ", text);
    }
    for (const config::CrossCheck& check : schema.checks())
        text += wrapped("Condition: " + check.message + ".", indent);
    for (const config::Deprecation& d : schema.deprecations())
        text += indent + "Old name, still accepted: " + d.old_name + " for " + d.new_name + ".\n";
}

std::string origin(const Described& d) {
    return "plugin " + d.plugin + " " + d.version + ", " + d.file;
}

/// `value` as YAML after "key:"; a map or a list of maps gets its own lines.
std::string yaml_value(const config::ConfigNode& value) {
    if (value.is_null()) return " null\n";
    const std::string text = config::to_yaml(config::ConfigNode::map({{"x", value}}));
    return text.substr(2);
}

std::string indented(const std::string& lines, const std::string& indent) {
    std::string out;
    for (std::size_t begin = 0; begin < lines.size();) {
        const std::size_t end = lines.find('\n', begin) + 1;
        out += indent + lines.substr(begin, end - begin);
        begin = end;
    }
    return out;
}

/// Whether the block contains a value for any field; YAML reads a block of comments as null.
bool has_values(const config::Schema& schema) {
    const auto& fields = schema.fields();
    return std::any_of(fields.begin(), fields.end(), [](const Field& field) {
        const bool open = field.type == FieldType::object && !field.default_value.is_null();
        return !field.required && (!open || has_values(*field.object));
    });
}

/// The fields with their defaults, with a comment before each; the conditions of a map come last.
void yaml_block(const config::Schema& schema, const std::string& indent, std::string& text) {
    for (const Field& field : schema.fields()) {
        text += wrapped(doc_text(field), indent + "# ");
        if (field.type == FieldType::object && !field.default_value.is_null()) {
            text += indent + (has_values(*field.object) ? "" : "# ") + field.name + ":\n";
            yaml_block(*field.object, indent + "  ", text);
        } else if (field.required) {
            text += indent + "# " + field.name + ": required\n";
        } else {
            text += indented(field.name + ":" + yaml_value(field.default_value), indent);
        }
    }
    for (const config::CrossCheck& check : schema.checks())
        text += wrapped("Condition: " + check.message + ".", indent + "# ");
}

}  // namespace

std::string list_text(const std::vector<Described>& all) {
    std::array<std::size_t, 3> width{};
    const auto cells = [](const Described& d) {
        return std::array<std::string, 3>{d.kind, d.id, d.plugin + " " + d.version};
    };
    for (const Described& d : all) {
        const auto row = cells(d);
        for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    std::string text;
    for (const Described& d : all) {
        const auto row = cells(d);
        for (std::size_t i = 0; i < row.size(); ++i)
            text += row[i] + std::string(width[i] + 2 - row[i].size(), ' ');
        text += d.summary + "\n";
    }
    return text;
}

ordered_json summary_json(const Described& d) {
    return {{"kind", d.kind},     {"id", d.id},           {"summary", d.summary},
            {"plugin", d.plugin}, {"version", d.version}, {"file", d.file}};
}

ordered_json full_json(const Described& d) {
    ordered_json json = summary_json(d);
    add_schema(*d.schema, "parameters", json);
    return json;
}

std::string description_text(const Described& d) {
    std::string text = d.kind + " '" + d.id + "': " + d.summary + "\n(" + origin(d) + ")\n";
    if (d.schema->fields().empty()) return text + "It has no parameters.\n";
    text += "Parameters:\n";
    schema_text(*d.schema, "  ", text);
    return text;
}

std::string yaml_text(const Described& d) {
    const std::string key = d.kind == "refinement" ? "refine" : d.kind;
    const bool in_list = d.kind == "observer" || d.kind == "filter";
    std::string text = wrapped(d.kind + " '" + d.id + "': " + d.summary, "# ");
    text += key + (in_list ? "s:\n  - type: " : ":\n  type: ") + d.id + "\n";
    yaml_block(*d.schema, in_list ? "    " : "  ", text);
    return text;
}

std::string doc_text(const Field& field) {
    const std::string summary = field.summary();
    return summary == "map" ? field.doc : field.doc + " (" + summary + ")";
}

std::string wrapped(const std::string& text, const std::string& indent) {
    constexpr std::size_t width = 100;
    std::string out;
    std::string line = indent;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const bool first = line.size() == indent.size();
        if (!first && line.size() + 1 + end - begin > width) {
            out += line + "\n";
            line = indent + text.substr(begin, end - begin);
        } else {
            line += (first ? "" : " ") + text.substr(begin, end - begin);
        }
        begin = end + 1;
    }
    return out + line + "\n";
}

}  // namespace dsc::app
