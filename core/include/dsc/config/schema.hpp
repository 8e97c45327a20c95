#pragma once
// Schema: the accepted keys of a map of the configuration. It is type-erased, so that hosts,
// editors and documentation can read it. Authors of strategies declare theirs with ParamSchema
// (params.hpp).

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/config/diagnostics.hpp>
#include <dsc/config/node.hpp>

namespace dsc::config {

enum class FieldType {
    boolean,
    integer,
    real,
    string,
    choice,  ///< a string out of `choices`
    file,    ///< a path; a relative path starts at the folder of the file that names it
    vec3,    ///< a list of three real numbers
    integer_list,
    real_list,
    string_list,    ///< each item is one of `choices` if there are any
    object,         ///< a map with its own schema
    object_list,    ///< a list of such maps
    strategy,       ///< `{type: ID, parameters...}` of `kind`
    strategy_list,  ///< a list of such maps
};

/// "real", "list of strategies", ...
std::string_view type_name(FieldType type);

/// An end of a range.
struct Bound {
    double value = 0;
    bool open = false;  ///< the end itself is excluded
};

class Schema;

/// One key of a map.
struct Field {
    std::string name;
    FieldType type = FieldType::string;
    std::string doc;   ///< one or more sentences, never empty
    std::string unit;  ///< "dimensionless", "length", "target lengths (L)", "steps", "radians",
                       ///< ...; empty if it does not apply
    std::optional<Bound> minimum;  ///< of a number, of every component or item
    std::optional<Bound> maximum;
    std::optional<std::size_t> min_size;  ///< of a list
    std::optional<std::size_t> max_size;
    std::vector<std::string> choices;
    std::vector<std::string> extensions;  ///< of a file, with the dot; empty for any
    bool required = false;                ///< must be given; has no default
    bool optional = false;                ///< may stay unset; `null` says so explicitly
    ConfigNode default_value;             ///< null for a required or an unset optional field
    std::vector<std::string> tags;  ///< "advanced": not on the first page of the documentation;
                                    ///< "costly"; "or_integers"; "or_keyed KEY"
    std::shared_ptr<const Schema> object;  ///< of an object or of each item of an object_list
    std::string kind;                      ///< of a strategy or of each item of a strategy_list
    std::int64_t storage_min = std::numeric_limits<std::int64_t>::min();  ///< range of the bound
                                                                          ///< member's type
    std::int64_t storage_max = std::numeric_limits<std::int64_t>::max();

    bool has_tag(std::string_view tag) const;
    /// The text in an item `{KEY: text}` of a list whose tag "or_keyed KEY" allows it; otherwise
    /// the item itself.
    const ConfigNode& text_of(const ConfigNode& item) const;
    /// "(0, 1]", "at least 1", "above 0"; empty without a bound.
    std::string range_text() const;
    /// "real, (0, 1], default 0.2": the accepted values, on one line.
    std::string summary() const;
};

/// An old name of a field that is still accepted with a warning.
struct Deprecation {
    std::string old_name;
    std::string new_name;
};

/// A condition on several fields, called with the resolved map.
struct CrossCheck {
    std::function<bool(const ConfigNode& resolved)> holds;
    std::string message;  ///< the condition that must hold, as a sentence
};

/// The fields of a map, in the order of their declaration.
class Schema {
public:
    /// Adds a field and returns its index.
    std::size_t add(Field field);
    void deprecate(std::string old_name, std::string new_name);
    void check(CrossCheck check);

    const std::vector<Field>& fields() const noexcept { return fields_; }
    Field& field(std::size_t index) { return fields_.at(index); }
    const std::vector<Deprecation>& deprecations() const noexcept { return deprecations_; }
    const std::vector<CrossCheck>& checks() const noexcept { return checks_; }
    /// nullptr if there is no such field.
    const Field* find(std::string_view name) const noexcept;
    std::vector<std::string> names() const;

    /// Faults of the declaration itself: a field without doc, a repeated name, a default outside
    /// its range, a bound on a string; for a strategy also a parameter called "type". Empty for a
    /// sound schema.
    std::vector<std::string> problems(bool of_strategy = false) const;

private:
    std::vector<Field> fields_;
    std::vector<Deprecation> deprecations_;
    std::vector<CrossCheck> checks_;
};

/// Gives the schemas of nested strategies. The plugin host implements it.
class StrategyLookup {
public:
    virtual ~StrategyLookup() = default;
    /// The schema of a strategy's parameters; nullptr if the kind has no such id. Valid as long as
    /// the lookup.
    virtual const Schema* find_schema(const std::string& kind, const std::string& id) const = 0;
    /// All ids of a kind, sorted.
    virtual std::vector<std::string> ids(const std::string& kind) const = 0;
};

/// A lookup without any strategy, for schemas without nested strategies.
class NoStrategies : public StrategyLookup {
public:
    const Schema* find_schema(const std::string&, const std::string&) const override {
        return nullptr;
    }
    std::vector<std::string> ids(const std::string&) const override { return {}; }
};

/// Checks `node` (a map, or null for an empty map) against the schema and returns the resolved map.
/// It contains all fields in the order of the schema; defaults are written out (null for an unset
/// optional field), also in nested objects and strategies; numbers have the type of the field;
/// relative file names are made absolute. All faults are added to `diagnostics`: unknown keys,
/// wrong types, values out of range, unknown strategies, missing keys, failed cross checks. After
/// an error the result is useful only for further checks. `owner` names the map in messages. Throws
/// StrategyError if a cross check throws. [setup]
ConfigNode validate(const ConfigNode& node, const Schema& schema, const StrategyLookup& lookup,
                    Diagnostics& diagnostics, const std::string& owner = "the experiment");

/// The same for one strategy `{type: ID, parameters...}` of `kind`; the result starts with `type`.
/// [setup]
ConfigNode validate_strategy(const ConfigNode& node, const std::string& kind,
                             const StrategyLookup& lookup, Diagnostics& diagnostics);

}  // namespace dsc::config
