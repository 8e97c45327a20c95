#include "describe.hpp"

#include <algorithm>
#include <array>
#include <dsc/config/yaml.hpp>

namespace dsc::app {
namespace {

using config::Field;
using config::FieldType;
using config::NodeType;
using nlohmann::ordered_json;

ordered_json to_json(const config::ConfigNode& node) {
    switch (node.type()) {
        case NodeType::null:
            return nullptr;
        case NodeType::boolean:
            return node.as_boolean();
        case NodeType::integer:
            return node.as_integer();
        case NodeType::real:
            return node.as_real();
        case NodeType::string:
            return node.as_string();
        case NodeType::list: {
            ordered_json list = ordered_json::array();
            for (const config::ConfigNode& item : node.items()) list.push_back(to_json(item));
            return list;
        }
        case NodeType::map: {
            ordered_json map = ordered_json::object();
            for (const config::ConfigEntry& entry : node.entries()) map[entry.key] = to_json(entry.value);
            return map;
        }
    }
    return nullptr;
}

ordered_json bound(const std::optional<config::Bound>& bound) {
    if (!bound) return nullptr;
    return {{"value", bound->value}, {"open", bound->open}};
}

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
        if (!field.choices.empty()) json["choices"] = field.choices;
        if (!field.kind.empty()) json["kind"] = field.kind;
        if (!field.tags.empty()) json["tags"] = field.tags;
        if (field.object) json["fields"] = fields_json(*field.object);
        fields.push_back(std::move(json));
    }
    return fields;
}

void fields_text(const config::Schema& schema, const std::string& indent, std::string& text) {
    for (const Field& field : schema.fields()) {
        text += indent + field.name + ": " + field.summary();
        if (!field.unit.empty() && field.unit != "1") text += " [" + field.unit + "]";
        text += "\n" + indent + "    " + field.doc + "\n";
        if (field.object) fields_text(*field.object, indent + "  ", text);
    }
}

std::string origin(const Described& d) {
    return d.version.empty() ? "part of the core" : "plugin " + d.plugin + " " + d.version + ", " + d.file;
}

/// `value` as it stands behind "key:", on lines of its own where it is a map or a list of maps.
std::string yaml_value(const config::ConfigNode& value) {
    if (value.is_null()) return " null\n";
    const std::string text = config::to_yaml(config::ConfigNode::map({{"x", value}}));
    return text.substr(2);
}

}  // namespace

std::string list_text(const std::vector<Described>& all) {
    std::array<std::size_t, 3> width{};
    const auto cells = [](const Described& d) {
        return std::array<std::string, 3>{d.kind, d.id,
                                          d.version.empty() ? d.plugin : d.plugin + " " + d.version};
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
    json["parameters"] = fields_json(*d.schema);
    return json;
}

std::string description_text(const Described& d) {
    std::string text = d.kind + " '" + d.id + "': " + d.summary + "\n(" + origin(d) + ")\n";
    if (d.schema->fields().empty()) return text + "It has no parameters.\n";
    text += "Parameters:\n";
    fields_text(*d.schema, "  ", text);
    return text;
}

std::string yaml_text(const Described& d) {
    std::string text =
        "# " + d.kind + " '" + d.id + "': " + d.summary + "\n" + d.kind + ":\n  type: " + d.id + "\n";
    for (const Field& field : d.schema->fields()) {
        text += "  # " + field.doc + " (" + field.summary() +
                (field.unit.empty() ? "" : "; unit " + field.unit) + ")\n";
        std::string value = field.name + ":" + (field.required ? " \n" : yaml_value(field.default_value));
        if (field.required) value = "# " + field.name + ": required\n";
        for (std::size_t begin = 0; begin < value.size();) {
            const std::size_t end = value.find('\n', begin) + 1;
            text += "  " + value.substr(begin, end - begin);
            begin = end;
        }
    }
    return text;
}

}  // namespace dsc::app
