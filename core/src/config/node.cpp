// The immutable tree of configuration values.
#include "dsc/config/node.hpp"

#include <cmath>
#include <unordered_set>
#include <utility>
#include <variant>

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/config/diagnostics.hpp>
#include <dsc/text/words.hpp>

#include "config/node_factory.hpp"

namespace dsc::config {

/// Paths share their beginnings; otherwise a hostile file could make them much larger than itself.
struct ConfigNode::PathPart {
    std::shared_ptr<const PathPart> parent;
    std::string key;
};

struct ConfigNode::Data {
    using Items = std::vector<ConfigNode>;
    using Entries = std::vector<ConfigEntry>;
    using Value =
        std::variant<std::monostate, bool, std::int64_t, double, std::string, Items, Entries>;

    Value value;
    SourcePosition position;
    std::shared_ptr<const PathPart> path;
    bool quoted = false;
};

std::string_view type_name(NodeType type) {
    switch (type) {
        case NodeType::null: return "null";
        case NodeType::boolean: return "a boolean";
        case NodeType::integer: return "an integer";
        case NodeType::real: return "a real number";
        case NodeType::string: return "a string";
        case NodeType::list: return "a list";
        case NodeType::map: return "a map";
    }
    return "null";
}

std::string join_path(std::string_view path, std::string_view key) {
    std::string out(path);
    if (!out.empty()) out += '.';
    return out += key;
}

ConfigNode::ConfigNode() {
    static const std::shared_ptr<const Data> null = std::make_shared<const Data>();
    data_ = null;
}
ConfigNode::ConfigNode(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
ConfigNode::ConfigNode(bool value)
    : data_(std::make_shared<const Data>(Data{value, {}, {}, false})) {}
ConfigNode::ConfigNode(double value)
    : data_(std::make_shared<const Data>(Data{value, {}, {}, false})) {}
ConfigNode::ConfigNode(const char* value) : ConfigNode(std::string(value)) {}
ConfigNode::ConfigNode(std::string_view value) : ConfigNode(std::string(value)) {}
ConfigNode::ConfigNode(std::string value)
    : data_(std::make_shared<const Data>(Data{std::move(value), {}, {}, false})) {}

ConfigNode ConfigNode::integer_node(std::int64_t value) {
    return ConfigNode(std::make_shared<const Data>(Data{value, {}, {}, false}));
}

void ConfigNode::integer_too_large() {
    throw ConfigError("config.range", "configuration",
                      "an integer above 9223372036854775807 cannot be stored",
                      "use a smaller integer or a real number");
}

ConfigNode ConfigNode::list() { return list({}); }
ConfigNode ConfigNode::map() { return map({}); }

ConfigNode ConfigNode::list(std::vector<ConfigNode> items) {
    return NodeFactory::list(std::move(items), {}).rebased(nullptr);
}

ConfigNode ConfigNode::map(std::vector<ConfigEntry> entries) {
    std::unordered_set<std::string_view> seen;
    for (const ConfigEntry& entry : entries) {
        if (!seen.insert(entry.key).second) {
            fail("config.duplicate_key", entry.position,
                 "duplicate key " + text::in_quotes(entry.key));
        }
    }
    return NodeFactory::map(std::move(entries), {}).rebased(nullptr);
}

ConfigNode NodeFactory::list(std::vector<ConfigNode> items, SourcePosition position) {
    return ConfigNode(std::make_shared<const ConfigNode::Data>(
        ConfigNode::Data{std::move(items), std::move(position), {}, false}));
}

ConfigNode NodeFactory::map(std::vector<ConfigEntry> entries, SourcePosition position) {
    return ConfigNode(std::make_shared<const ConfigNode::Data>(
        ConfigNode::Data{std::move(entries), std::move(position), {}, false}));
}

ConfigNode NodeFactory::rooted(const ConfigNode& node) { return node.rebased(nullptr); }

NodeType ConfigNode::type() const noexcept { return static_cast<NodeType>(data_->value.index()); }

void ConfigNode::wrong_type(std::string_view wanted) const {
    const std::string name = path();
    fail("config.type", position(),
         (name.empty() ? std::string("the value") : text::in_quotes(name)) + " is " +
             std::string(type_name(type())) + ", not " + std::string(wanted));
}

bool ConfigNode::as_boolean() const {
    if (const bool* value = std::get_if<bool>(&data_->value)) return *value;
    wrong_type("a boolean");
}

std::int64_t ConfigNode::as_integer() const {
    constexpr double exact_to = 9007199254740992.0;  // 2^53
    if (const auto* value = std::get_if<std::int64_t>(&data_->value)) return *value;
    if (const auto* value = std::get_if<double>(&data_->value)) {
        if (std::abs(*value) <= exact_to && std::trunc(*value) == *value)
            return static_cast<std::int64_t>(*value);
    }
    wrong_type("an integer");
}

double ConfigNode::as_real() const {
    if (const auto* value = std::get_if<double>(&data_->value)) return *value;
    if (const auto* value = std::get_if<std::int64_t>(&data_->value))
        return static_cast<double>(*value);
    wrong_type("a number");
}

const std::string& ConfigNode::as_string() const {
    if (const auto* value = std::get_if<std::string>(&data_->value)) return *value;
    wrong_type("a string");
}

const std::vector<ConfigNode>& ConfigNode::items() const {
    if (const auto* value = std::get_if<Data::Items>(&data_->value)) return *value;
    wrong_type("a list");
}

const std::vector<ConfigEntry>& ConfigNode::entries() const {
    if (const auto* value = std::get_if<Data::Entries>(&data_->value)) return *value;
    wrong_type("a map");
}

std::size_t ConfigNode::size() const noexcept {
    if (is_list()) return std::get<Data::Items>(data_->value).size();
    return is_map() ? std::get<Data::Entries>(data_->value).size() : 0;
}

const ConfigEntry* ConfigNode::find_entry(std::string_view key) const noexcept {
    const auto* entries = std::get_if<Data::Entries>(&data_->value);
    if (!entries) return nullptr;
    for (const ConfigEntry& entry : *entries) {
        if (entry.key == key) return &entry;
    }
    return nullptr;
}

const ConfigNode* ConfigNode::find(std::string_view key) const noexcept {
    const ConfigEntry* entry = find_entry(key);
    return entry ? &entry->value : nullptr;
}

const ConfigNode& ConfigNode::at(std::string_view key) const {
    if (!is_map()) wrong_type("a map");
    if (const ConfigNode* found = find(key)) return *found;
    fail("config.missing", position(), text::in_quotes(join_path(path(), key)) + " is missing");
}

const ConfigNode& ConfigNode::at(std::size_t index) const {
    const std::vector<ConfigNode>& list = items();
    if (index < list.size()) return list[index];
    fail("config.missing", position(),
         fmt::format("{} is missing: the list has {} items",
                     text::in_quotes(join_path(path(), std::to_string(index))), list.size()));
}

std::string ConfigNode::path() const {
    std::string out;
    for (const PathPart* part = data_->path.get(); part; part = part->parent.get()) {
        out = out.empty() ? part->key : join_path(part->key, out);
    }
    return out;
}

const SourcePosition& ConfigNode::position() const noexcept { return data_->position; }
bool ConfigNode::quoted() const noexcept { return data_->quoted; }

ConfigNode ConfigNode::placed(SourcePosition position, bool quoted) const {
    return ConfigNode(
        std::make_shared<const Data>(Data{data_->value, std::move(position), data_->path, quoted}));
}

ConfigNode ConfigNode::rebased(const std::shared_ptr<const PathPart>& parent,
                               const std::string& key) const {
    const PathPart* old = data_->path.get();
    const bool in_place = old && old->parent == parent && old->key == key;
    return in_place ? *this : rebased(std::make_shared<const PathPart>(PathPart{parent, key}));
}

ConfigNode ConfigNode::rebased(std::shared_ptr<const PathPart> path) const {
    auto data = std::make_shared<Data>(*data_);
    data->path = path;
    if (auto* list = std::get_if<Data::Items>(&data->value)) {
        for (std::size_t i = 0; i < list->size(); ++i)
            (*list)[i] = (*list)[i].rebased(path, std::to_string(i));
    } else if (auto* map = std::get_if<Data::Entries>(&data->value)) {
        for (ConfigEntry& entry : *map) entry.value = entry.value.rebased(path, entry.key);
    }
    return ConfigNode(std::move(data));
}

ConfigNode ConfigNode::with_path(const std::string& path) const {
    if (path.empty()) return rebased(nullptr);
    return rebased(std::make_shared<const PathPart>(PathPart{nullptr, path}));
}

ConfigNode ConfigNode::with(const std::string& key, ConfigNode value) const {
    const ConfigEntry* old = find_entry(key);
    return with(key, std::move(value), old ? old->position : SourcePosition{});
}

ConfigNode ConfigNode::with(const std::string& key, ConfigNode value,
                            SourcePosition key_position) const {
    if (!is_map() && !is_null()) wrong_type("a map");
    auto data = std::make_shared<Data>(*data_);
    if (is_null()) data->value = Data::Entries{};
    auto& entries = std::get<Data::Entries>(data->value);
    value = value.rebased(data->path, key);
    for (ConfigEntry& entry : entries) {
        if (entry.key != key) continue;
        entry.value = std::move(value);
        entry.position = std::move(key_position);
        return ConfigNode(std::move(data));
    }
    entries.emplace_back(key, std::move(value), std::move(key_position));
    return ConfigNode(std::move(data));
}

ConfigNode ConfigNode::without(std::string_view key) const {
    if (!is_map()) wrong_type("a map");
    auto data = std::make_shared<Data>(*data_);
    auto& entries = std::get<Data::Entries>(data->value);
    std::erase_if(entries, [&](const ConfigEntry& entry) { return entry.key == key; });
    return ConfigNode(std::move(data));
}

ConfigNode ConfigNode::with_item(std::size_t index, ConfigNode value) const {
    at(index);  // throws if this is not a list or is too short
    auto data = std::make_shared<Data>(*data_);
    std::get<Data::Items>(data->value)[index] = value.rebased(data->path, std::to_string(index));
    return ConfigNode(std::move(data));
}

bool operator==(const ConfigNode& a, const ConfigNode& b) {
    if (a.data_ == b.data_) return true;
    if (a.type() != b.type()) return false;
    if (a.is_map()) {
        const auto& left = a.entries();
        const auto& right = b.entries();
        if (left.size() != right.size()) return false;
        for (std::size_t i = 0; i < left.size(); ++i) {
            if (left[i].key != right[i].key || left[i].value != right[i].value) return false;
        }
        return true;
    }
    if (a.is_list()) return a.items() == b.items();
    switch (a.type()) {
        case NodeType::boolean: return a.as_boolean() == b.as_boolean();
        case NodeType::integer: return a.as_integer() == b.as_integer();
        case NodeType::real: return a.as_real() == b.as_real();
        case NodeType::string: return a.as_string() == b.as_string();
        default: return true;
    }
}

}  // namespace dsc::config
