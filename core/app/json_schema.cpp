// Writes the JSON Schema of the whole experiment.
#include "json_schema.hpp"

#include <map>

#include <dsc/plugin/kind.hpp>
#include <dsc/run/experiment.hpp>

namespace dsc::app {
namespace {

using nlohmann::ordered_json;

std::string id_definition(const Described& d) { return kind_definition(d.kind) + "." + d.id; }

std::string joined(const std::string& text, const std::string& more) {
    return more.empty() ? text : text + ". " + more;
}

/// All strategies by kind; also those kinds that an experiment names but that have no strategy.
std::map<std::string, std::vector<Described>> by_kind(const std::vector<Described>& strategies) {
    std::map<std::string, std::vector<Described>> kinds;
    for (const plugin::Kind kind : plugin::all_kinds) kinds[std::string(plugin::kind_name(kind))];
    for (const Described& d : strategies) kinds[d.kind].push_back(d);
    return kinds;
}

ordered_json if_type(const std::string& id, ordered_json then) {
    return {{"if", {{"properties", {{"type", {{"const", id}}}}}, {"required", {"type"}}}},
            {"then", std::move(then)}};
}

/// The strategies of a kind, with the parameters of each.
ordered_json kind_schema(const std::string& kind, const std::vector<Described>& members) {
    ordered_json ids = ordered_json::array(), summaries = ordered_json::array(),
                 cases = ordered_json::array();
    for (const Described& d : members) {
        ids.push_back(d.id);
        summaries.push_back(d.summary);
        cases.push_back(if_type(d.id, reference(id_definition(d))));
    }
    ordered_json schema = {
        {"properties",
         {{"type",
           {{"description",
             "Which " + kind + " strategy; its parameters are keys of the same map."},
            {"type", "string"},
            {"if", reference(variable_definition())},
            {"else", {{"enum", ids}, {"enumDescriptions", summaries}}}}}}}};
    if (!cases.empty()) schema["allOf"] = cases;
    return schema;
}

/// A strategy must name its type and contain the keys that this type requires.
ordered_json kind_required(const std::vector<Described>& members) {
    ordered_json schema = {{"required", {"type"}}};
    for (const Described& d : members) {
        ordered_json needed = required_schema(*d.schema);
        if (!needed.empty()) schema["allOf"].push_back(if_type(d.id, std::move(needed)));
    }
    return schema;
}

ordered_json definitions(const std::vector<Described>& strategies) {
    ordered_json all = {{variable_definition(),
                         {{"description", "Text that contains an environment variable, ${NAME}."},
                          {"type", "string"},
                          {"pattern", R"((^|[^$])\$\{[A-Za-z_][A-Za-z0-9_]*\})"}}}};
    for (const auto& [kind, members] : by_kind(strategies)) {
        all[kind_definition(kind)] = kind_schema(kind, members);
        all[required_definition(kind)] = kind_required(members);
        for (const Described& d : members) {
            ordered_json& schema = all[id_definition(d)];
            schema = {{"description", joined(d.summary, conditions_text(*d.schema))}};
            schema.update(map_schema(*d.schema, d.id));
            schema.erase("type");  // where null is allowed, an `if` on the keys of a map is also
                                   // true for null
        }
    }
    return all;
}

}  // namespace

std::string variable_definition() { return "variable"; }
std::string kind_definition(const std::string& kind) { return kind; }
std::string required_definition(const std::string& kind) { return "complete_" + kind; }

ordered_json reference(const std::string& definition) {
    return {{"$ref", "#/definitions/" + definition}};
}

ordered_json json_schema(const std::vector<Described>& strategies) {
    const config::Schema& experiment = *run::experiment_schema();
    ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                           {"title", "dsc experiment, format 1"},
                           {"description", conditions_text(experiment)}};
    schema.update(map_schema(experiment));
    schema["properties"]["include"] = {
        {"description", "A file or a list of files that this file completes: maps are merged, "
                        "lists are replaced, and this file comes last."},
        {"type", {"string", "array"}},
        {"items", {{"type", "string"}}}};
    schema["if"] = {{"required", {"include"}}};
    schema["else"] = required_schema(experiment);
    schema["definitions"] = definitions(strategies);
    return schema;
}

}  // namespace dsc::app
