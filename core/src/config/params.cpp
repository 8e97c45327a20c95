// The parts of ParamSchema that do not depend on the struct.
#include "dsc/config/params.hpp"

#include <dsc/base/error.hpp>
#include <dsc/config/spelling.hpp>

namespace dsc::config {

ConfigNode strategy_node(const StrategyConfig& strategy) {
    if (strategy.empty()) return {};
    std::vector<ConfigEntry> entries;
    entries.emplace_back("type", strategy.type);
    if (strategy.params.is_map()) {
        for (const ConfigEntry& entry : strategy.params.entries()) entries.push_back(entry);
    }
    return ConfigNode::map(std::move(entries)).placed(strategy.params.position());
}

StrategyConfig strategy_from(const ConfigNode& node) {
    if (node.is_null()) return {};
    return {node.at("type").as_string(), node.without("type")};
}

void require_sound(const Schema& schema) {
    const std::vector<std::string> problems = schema.problems();
    if (!problems.empty()) {
        throw PluginError("plugin.schema", "declaration of parameters", join(problems, "; "),
                          "correct the declaration in the plugin");
    }
}

FieldBuilder& FieldBuilder::size(std::size_t least, std::size_t greatest) {
    field().min_size = least;
    field().max_size = greatest;
    return *this;
}

FieldBuilder& FieldBuilder::required() {
    field().required = true;
    field().default_value = ConfigNode();
    return *this;
}

FieldBuilder& FieldBuilder::optional() {
    field().optional = true;
    field().required = false;
    return *this;
}

}  // namespace dsc::config
