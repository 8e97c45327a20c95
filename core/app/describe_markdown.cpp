// Writes the reference page of a strategy.
#include <dsc/config/field_text.hpp>

#include "describe.hpp"

namespace dsc::app {
namespace {

using config::Field;

/// Text for a cell of a table: bars and line ends are replaced, since they would end the cell.
std::string cell(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

/// Makes a sentence of a summary.
std::string sentence(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
        text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text + ".";
}

std::string type_cell(const Field& field) {
    std::string text = cell(config::type_text(field));
    if (!field.kind.empty()) text = "[" + text + "](README.md#" + field.kind + ")";
    return field.has_tag("advanced") ? text + "; advanced" : text;
}

std::string default_cell(const Field& field) {
    const std::string text = config::default_text(field);
    return field.required || text == "unset" ? text : code(cell(text));
}

/// What a schema and its nested schemas declare besides fields.
struct Besides {
    std::string conditions;
    std::string old_names;
};

void add_rows(const config::Schema& schema, const std::string& path, std::string& rows,
              Besides& besides) {
    for (const Field& field : schema.fields()) {
        const std::string name = config::join_path(path, field.name);
        rows += "| " + code(name) + " | " + type_cell(field) + " | " + default_cell(field) + " | " +
                cell(field.unit) + " | " + cell(field.doc) + " |\n";
        if (!field.object) continue;
        const bool list = field.type == config::FieldType::object_list;
        add_rows(*field.object, list ? name + "[]" : name, rows, besides);
    }
    const std::string where = path.empty() ? "" : code(path) + ": ";
    for (const config::CrossCheck& check : schema.checks())
        besides.conditions += "- " + where + check.message + "\n";
    for (const config::Deprecation& d : schema.deprecations()) {
        besides.old_names += "- " + code(config::join_path(path, d.old_name)) + ", now " +
                             code(config::join_path(path, d.new_name)) + "\n";
    }
}

}  // namespace

std::string markdown_text(const Described& d) {
    std::string text = "# " + d.kind + " `" + d.id + "`\n" + sentence(d.summary) + "\n\n";
    if (d.schema->fields().empty()) return text + "It has no parameters.\n";
    std::string rows;
    Besides besides;
    add_rows(*d.schema, "", rows, besides);
    text +=
        "| parameter | type | default | unit | meaning |\n| --- | --- | --- | --- | --- |\n" + rows;
    if (!besides.conditions.empty()) text += "\n## Conditions\n" + besides.conditions;
    if (!besides.old_names.empty()) text += "\n## Old names, still accepted\n" + besides.old_names;
    return text + "\n## With all defaults\n```yaml\n" + yaml_text(d) + "```\n";
}

}  // namespace dsc::app
