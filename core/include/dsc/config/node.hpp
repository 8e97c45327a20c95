#pragma once
// ConfigNode: an immutable tree of configuration values that remembers where each value was
// written.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <dsc/config/source.hpp>

namespace dsc::config {

enum class NodeType { null, boolean, integer, real, string, list, map };

/// "a boolean", "a list", ...: the type as messages name it.
std::string_view type_name(NodeType type);

struct ConfigEntry;
struct NodeFactory;

/// A value of a configuration: null, a scalar, a list, or a map that keeps the order of its keys.
/// Copies share the tree; nothing can change it. Plain types convert to nodes:
/// `ConfigNode::map({{"type", "grid"}, {"cells", 30}, {"axis", ConfigNode::list({0.0,
/// 0.0, 1.0})}})`. [setup]
class ConfigNode {
public:
    /// Null.
    ConfigNode();
    ConfigNode(bool value);              // NOLINT(google-explicit-constructor): values convert
    ConfigNode(double value);            // NOLINT(google-explicit-constructor)
    ConfigNode(const char* value);       // NOLINT(google-explicit-constructor)
    ConfigNode(std::string value);       // NOLINT(google-explicit-constructor)
    ConfigNode(std::string_view value);  // NOLINT(google-explicit-constructor)
    /// Any integer type; a value above the largest std::int64_t throws ConfigError "config.range".
    template <class Integer>
    requires(std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>)
        ConfigNode(Integer value)
        : ConfigNode(from_integer(value)) {}  // NOLINT(google-explicit-constructor)

    static ConfigNode list(std::vector<ConfigNode> items);
    static ConfigNode list();
    /// Keys must differ, else throws ConfigError "config.duplicate_key".
    static ConfigNode map(std::vector<ConfigEntry> entries);
    static ConfigNode map();

    NodeType type() const noexcept;
    bool is_null() const noexcept { return type() == NodeType::null; }
    bool is_boolean() const noexcept { return type() == NodeType::boolean; }
    bool is_integer() const noexcept { return type() == NodeType::integer; }
    bool is_real() const noexcept { return type() == NodeType::real; }
    bool is_number() const noexcept { return is_integer() || is_real(); }
    bool is_string() const noexcept { return type() == NodeType::string; }
    bool is_list() const noexcept { return type() == NodeType::list; }
    bool is_map() const noexcept { return type() == NodeType::map; }

    /// The value; another type throws ConfigError "config.type" with the node's position.
    bool as_boolean() const;
    /// Also accepts a real number that is exactly an integer (1e3), at most 2^53 in magnitude.
    std::int64_t as_integer() const;
    /// Also accepts an integer.
    double as_real() const;
    const std::string& as_string() const;
    const std::vector<ConfigNode>& items() const;     ///< of a list
    const std::vector<ConfigEntry>& entries() const;  ///< of a map, in order

    /// Number of items or entries, 0 for a scalar.
    std::size_t size() const noexcept;
    /// The value at `key` of a map; nullptr if it is absent or this is not a map. Valid as long as
    /// this node.
    const ConfigNode* find(std::string_view key) const noexcept;
    const ConfigEntry* find_entry(std::string_view key) const noexcept;
    /// The value at `key`; throws ConfigError "config.missing" with the position of this node.
    const ConfigNode& at(std::string_view key) const;
    /// The item at `index`; throws ConfigError "config.missing" beyond the end.
    const ConfigNode& at(std::size_t index) const;

    /// Dotted path from the root, "schedule.0.steps"; empty at the root.
    std::string path() const;
    const SourcePosition& position() const noexcept;
    /// True for a scalar written in quotes (or as a block). It is always a string.
    bool quoted() const noexcept;

    /// The same value with another place.
    ConfigNode placed(SourcePosition position, bool quoted = false) const;
    /// The same tree with the paths of all its nodes starting at `path`.
    ConfigNode with_path(const std::string& path) const;
    /// A copy of a map with `key` replaced at its place, or added at the end. Null counts as an
    /// empty map.
    ConfigNode with(const std::string& key, ConfigNode value) const;
    ConfigNode with(const std::string& key, ConfigNode value, SourcePosition key_position) const;
    /// A copy of a map without `key`.
    ConfigNode without(std::string_view key) const;
    /// A copy of a list with the item at `index` replaced; throws ConfigError "config.missing"
    /// beyond the end.
    ConfigNode with_item(std::size_t index, ConfigNode value) const;

    /// Equal values in equal order. An integer differs from a real number. Places are not compared.
    friend bool operator==(const ConfigNode& a, const ConfigNode& b);
    friend bool operator!=(const ConfigNode& a, const ConfigNode& b) { return !(a == b); }

private:
    friend struct NodeFactory;
    struct Data;
    struct PathPart;
    explicit ConfigNode(std::shared_ptr<const Data> data);
    static ConfigNode integer_node(std::int64_t value);
    [[noreturn]] static void integer_too_large();
    template <class Integer>
    static ConfigNode from_integer(Integer value) {
        if constexpr (std::is_unsigned_v<Integer> && sizeof(Integer) >= sizeof(std::int64_t)) {
            if (value > static_cast<Integer>(std::numeric_limits<std::int64_t>::max()))
                integer_too_large();
        }
        return integer_node(static_cast<std::int64_t>(value));
    }
    ConfigNode rebased(const std::shared_ptr<const PathPart>& parent, const std::string& key) const;
    ConfigNode rebased(std::shared_ptr<const PathPart> path) const;
    [[noreturn]] void wrong_type(std::string_view wanted) const;

    std::shared_ptr<const Data> data_;
};

/// A key of a map with its value.
struct ConfigEntry {
    ConfigEntry(std::string entry_key, ConfigNode entry_value, SourcePosition entry_position = {})
        : key(std::move(entry_key)),
          value(std::move(entry_value)),
          position(std::move(entry_position)) {}

    std::string key;
    ConfigNode value;
    SourcePosition position;  ///< of the key
};

/// "a.b" for the path "a" and the key "b"; the key alone at the root.
std::string join_path(std::string_view path, std::string_view key);

}  // namespace dsc::config
