// Validates a tree against schemas: finds all faults and writes out all defaults.
#include <algorithm>
#include <exception>
#include <set>
#include <utility>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/config/schema.hpp>
#include <dsc/config/spelling.hpp>
#include <dsc/text/utf8.hpp>
#include <dsc/text/words.hpp>

#include "config/field_value.hpp"

namespace dsc::config {
namespace {

/// Where a key is accepted, for example "curvature 'implicit_fairing'".
struct Accepted {
    std::string key;
    std::string place;
};

class Validator {
public:
    Validator(const StrategyLookup& lookup, Diagnostics& diagnostics)
        : lookup_(lookup), diagnostics_(diagnostics) {}

    /// Collects all keys that are accepted anywhere, for hints about unknown keys.
    void learn(const Schema& schema, const std::string& owner, const std::string& path = "") {
        for (const Field& field : schema.fields()) {
            accepted_.push_back({field.name, path.empty() ? owner : "'" + path + "' of " + owner});
            if (field.object) learn(*field.object, owner, join_path(path, field.name));
            if (!field.kind.empty()) learn_kind(field.kind);
        }
    }
    void learn_kind(const std::string& kind) {
        if (!known_kinds_.insert(kind).second) return;
        for (const std::string& id : lookup_.ids(kind)) {
            if (const Schema* schema = lookup_.find_schema(kind, id))
                learn(*schema, kind + " '" + id + "'");
        }
    }

    /// The map to validate.
    struct Map {
        const Schema& schema;
        std::string path;
        std::string owner;                 ///< "velocity 'point_cloud'"
        SourcePosition fallback;           ///< place of a map that has none
        const ConfigNode* type = nullptr;  ///< the strategy's id, which is not a field of the
                                           ///< schema
    };

    ConfigNode resolve_map(const ConfigNode& node, const Map& map) {
        const SourcePosition& position = node.position().known() ? node.position() : map.fallback;
        if (!node.is_map() && !node.is_null()) {
            diagnostics_.error("config.wrong_type", position,
                               subject(map) + " must be a map, not " + value_text(node),
                               "accepted keys: " + join(map.schema.names()));
            return node;
        }
        const std::size_t errors_before = diagnostics_.error_count();
        const ConfigNode given = renamed(node, map);
        report_unknown(given, map);
        std::vector<ConfigEntry> entries;
        if (map.type) entries.emplace_back("type", *map.type);
        for (const Field& field : map.schema.fields()) {
            const ConfigEntry* entry = given.find_entry(field.name);
            entries.emplace_back(field.name, resolve_field(field, entry, map, position),
                                 entry ? entry->position : SourcePosition{});
        }
        const ConfigNode resolved =
            ConfigNode::map(std::move(entries)).placed(node.position()).with_path(map.path);
        if (diagnostics_.error_count() == errors_before) run_checks(resolved, map, position);
        return resolved;
    }

    ConfigNode resolve_strategy(const ConfigNode& node, const std::string& kind,
                                const std::string& path, const SourcePosition& fallback) {
        const SourcePosition& position = node.position().known() ? node.position() : fallback;
        const std::string name = path.empty() ? "the " + kind : "'" + path + "'";
        if (!node.is_map()) {
            const bool bare = node.is_string();
            diagnostics_.error(
                "config.wrong_type", position,
                name + " must be a " + kind + " strategy {type: ID, ...}, not " + value_text(node),
                bare ? "write {type: " + text::printable(node.as_string()) + "}" : "",
                {known_ids(kind)});
            return node;
        }
        const ConfigNode* type = node.find("type");
        if (!type || !type->is_string()) {
            const bool missing = !type || type->is_null();
            diagnostics_.error(
                missing ? "config.missing" : "config.wrong_type",
                type ? type->position() : position,
                missing ? name + " does not say which " + kind + " to use: 'type' is missing"
                        : "'" + join_path(path, "type") + "' must be the name of a " + kind +
                              " strategy, not " + value_text(*type),
                "", {known_ids(kind)});
            return node;
        }
        const std::string& id = type->as_string();
        const Schema* schema = lookup_.find_schema(kind, id);
        if (!schema) {
            const auto near = closest(id, lookup_.ids(kind));
            diagnostics_.error(
                "config.unknown_strategy", type->position().known() ? type->position() : position,
                "unknown " + kind + " " + text::in_quotes(id),
                near ? "did you mean '" + *near + "'?" : kind_hint(id), {known_ids(kind)});
            return node;
        }
        if (schema->find("type")) {
            throw PluginError("plugin.schema", fmt::format("{} '{}'", kind, id),
                              "it declares a parameter 'type', but this key selects the strategy",
                              "rename the parameter");
        }
        return resolve_map(node, {*schema, path, kind + " '" + id + "'", position, type});
    }

private:
    static std::string subject(const Map& map) {
        return map.path.empty() ? map.owner : "'" + map.path + "'";
    }

    std::string known_ids(const std::string& kind) const {
        const std::vector<std::string> ids = lookup_.ids(kind);
        return ids.empty() ? "no " + kind + " strategy is loaded"
                           : "known " + kind + " strategies: " + join(ids);
    }

    /// The kind to which an id belongs if it was used for another kind.
    std::string kind_hint(const std::string& id) const {
        for (const std::string& kind : known_kinds_) {
            if (lookup_.find_schema(kind, id))
                return text::in_quotes(id) + " is of the kind " + kind;
        }
        return {};
    }

    /// The map with old names replaced by new ones.
    ConfigNode renamed(const ConfigNode& node, const Map& map) {
        const auto& old_names = map.schema.deprecations();
        const bool affected =
            std::any_of(old_names.begin(), old_names.end(),
                        [&](const Deprecation& d) { return node.find(d.old_name) != nullptr; });
        if (!affected) return node;
        ConfigNode out = node;
        for (const Deprecation& d : old_names) {
            const ConfigEntry* entry = node.find_entry(d.old_name);
            if (!entry) continue;
            out = out.without(d.old_name);
            if (out.find(d.new_name)) {
                diagnostics_.error("config.duplicate_key", entry->position,
                                   "'" + d.old_name + "' is the old name of '" + d.new_name +
                                       "', and both are given",
                                   "remove '" + d.old_name + "'");
                continue;
            }
            diagnostics_.warning(
                "config.deprecated", entry->position,
                "'" + d.old_name + "' in " + map.owner + " is now called '" + d.new_name + "'",
                "rename it");
            out = out.with(d.new_name, entry->value, entry->position);
        }
        return out;
    }

    void report_unknown(const ConfigNode& given, const Map& map) {
        if (!given.is_map()) return;
        for (const ConfigEntry& entry : given.entries()) {
            if ((map.type && entry.key == "type") || map.schema.find(entry.key)) continue;
            report_unknown(entry, map);
        }
    }

    void report_unknown(const ConfigEntry& entry, const Map& map) {
        std::vector<std::string> names = map.schema.names();
        if (map.type) names.insert(names.begin(), "type");
        std::string hint;
        if (const auto near = closest(entry.key, names)) {
            const Field* field = map.schema.find(*near);
            hint = "did you mean '" + *near + "'?" + (field ? " (" + field->summary() + ")" : "");
        } else {
            hint = belongs_to(entry.key);
        }
        std::string accepted =
            names.empty() ? "no keys are accepted here" : "accepted keys: " + join(names);
        diagnostics_.error("config.unknown_key",
                           entry.position.known() ? entry.position : map.fallback,
                           "unknown key " + text::in_quotes(entry.key) + " in " + map.owner, hint,
                           {std::move(accepted)});
    }

    std::string belongs_to(const std::string& key) const {
        std::vector<std::string> places;
        for (const Accepted& a : accepted_) {
            const bool fresh = std::find(places.begin(), places.end(), a.place) == places.end();
            if (a.key == key && fresh && places.size() < 3) places.push_back(a.place);
        }
        return places.empty() ? "" : text::in_quotes(key) + " belongs to " + join(places, " or ");
    }

    ConfigNode resolve_field(const Field& field, const ConfigEntry* entry, const Map& map,
                             const SourcePosition& owner_place) {
        const std::string path = join_path(map.path, field.name);
        if (!entry) {
            if (field.required) {
                diagnostics_.error("config.missing", owner_place,
                                   "'" + path + "' is missing in " + map.owner, field.summary(),
                                   {field.doc});
                return {};
            }
            return resolve_default(field, path, owner_place);
        }
        const ConfigNode& value = entry->value;
        const SourcePosition& place = value.position().known() ? value.position() : owner_place;
        if (value.is_null()) {
            if (field.optional) return value;
            if (field.type == FieldType::object) return resolve_default(field, path, place);
            diagnostics_.error("config.wrong_type", place, "'" + path + "' has no value",
                               "accepted: " + field.summary());
            return {};
        }
        return resolve_given(field, value, path, place);
    }

    ConfigNode resolve_default(const Field& field, const std::string& path,
                               const SourcePosition& place) {
        if (field.type == FieldType::object && !field.optional)
            return resolve_given(field, {}, path, place);
        if (field.default_value.is_null()) return {};
        return resolve_given(field, field.default_value, path, place);
    }

    ConfigNode resolve_given(const Field& field, const ConfigNode& value, const std::string& path,
                             const SourcePosition& place) {
        switch (field.type) {
            case FieldType::object:
                return resolve_map(value, {*field.object, path, "'" + path + "'", place});
            case FieldType::strategy: return resolve_strategy(value, field.kind, path, place);
            case FieldType::object_list:
            case FieldType::strategy_list: return resolve_list(field, value, path, place);
            default: return resolve_value(field, value, path, place, diagnostics_);
        }
    }

    ConfigNode resolve_list(const Field& field, const ConfigNode& value, const std::string& path,
                            const SourcePosition& place) {
        if (!value.is_list()) {
            diagnostics_.error("config.wrong_type", place,
                               "'" + path + "' must be a list, not " + value_text(value),
                               value.is_map() ? "write [{...}], or '- ' before each item"
                                              : "accepted: " + field.summary());
            return value;
        }
        const std::size_t least = field.min_size.value_or(0);
        const std::size_t most = field.max_size.value_or(value.size());
        if (value.size() < least || value.size() > most) {
            diagnostics_.error(
                "config.list_size", place,
                fmt::format("'{}' must have {}, not {}", path,
                            value.size() < least ? "at least " + text::counted(least, "item")
                                                 : "at most " + text::counted(most, "item"),
                            value.size()),
                "accepted: " + field.summary());
        }
        std::vector<ConfigNode> items;
        for (std::size_t i = 0; i < value.size(); ++i) {
            const std::string at = join_path(path, std::to_string(i));
            const ConfigNode& item = value.items()[i];
            items.push_back(field.type == FieldType::strategy_list
                                ? resolve_strategy(item, field.kind, at, place)
                                : resolve_map(item, {*field.object, at, "'" + at + "'", place}));
        }
        return ConfigNode::list(std::move(items)).placed(value.position()).with_path(path);
    }

    void run_checks(const ConfigNode& resolved, const Map& map, const SourcePosition& place) {
        for (const CrossCheck& check : map.schema.checks()) {
            bool holds = false;
            try {
                holds = check.holds(resolved);
            } catch (const std::exception& error) {
                throw StrategyError(
                    "strategy.check", map.owner,
                    fmt::format("a check of its parameters threw: {}", error.what()),
                    "report this to the plugin's authors");
            }
            if (holds) continue;
            const ConfigNode* culprit = first_named(check.message, resolved);
            diagnostics_.error("config.check", culprit ? culprit->position() : place,
                               map.owner + ": " + check.message);
        }
    }

    /// Of the given values, the one whose key a message names first; nullptr if the message names
    /// none.
    static const ConfigNode* first_named(const std::string& message, const ConfigNode& map) {
        const ConfigNode* first = nullptr;
        std::size_t first_at = std::string::npos;
        for (const ConfigEntry& entry : map.entries()) {
            if (!entry.value.position().known()) continue;
            const std::size_t at = text::find_word(message, entry.key);
            if (at < first_at) {
                first = &entry.value;
                first_at = at;
            }
        }
        return first;
    }

    const StrategyLookup& lookup_;
    Diagnostics& diagnostics_;
    std::vector<Accepted> accepted_;
    std::set<std::string> known_kinds_;
};

}  // namespace

ConfigNode validate(const ConfigNode& node, const Schema& schema, const StrategyLookup& lookup,
                    Diagnostics& diagnostics, const std::string& owner) {
    Validator validator(lookup, diagnostics);
    validator.learn(schema, owner);
    return validator.resolve_map(node, {schema, node.path(), owner, node.position()});
}

ConfigNode validate_strategy(const ConfigNode& node, const std::string& kind,
                             const StrategyLookup& lookup, Diagnostics& diagnostics) {
    Validator validator(lookup, diagnostics);
    validator.learn_kind(kind);
    return validator.resolve_strategy(node, kind, node.path(), node.position());
}

}  // namespace dsc::config
