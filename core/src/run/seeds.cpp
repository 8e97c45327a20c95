// Searches an experiment for what the seed decides.
#include "dsc/run/seeds.hpp"

#include <algorithm>

namespace dsc::run {
namespace {

using config::ConfigNode;
using config::Field;
using config::FieldType;

bool any_stochastic(const ConfigNode& map, const config::Schema& schema,
                    const plugin::Catalogue& catalogue);

bool is_stochastic(const ConfigNode& strategy, const std::string& kind,
                   const plugin::Catalogue& catalogue) {
    const ConfigNode* type = strategy.is_map() ? strategy.find("type") : nullptr;
    const std::optional<plugin::Kind> known = plugin::find_kind(kind);
    if (type == nullptr || !type->is_string() || !known) return false;
    const std::optional<plugin::StrategyInfo> info = catalogue.find(*known, type->as_string());
    if (!info) return false;
    return info->strategy->traits.stochastic ||
           any_stochastic(strategy, *info->strategy->schema, catalogue);
}

bool any_in(const ConfigNode& value, const Field& field, const plugin::Catalogue& catalogue) {
    if (value.is_list()) {
        return std::any_of(value.items().begin(), value.items().end(),
                           [&](const ConfigNode& item) { return any_in(item, field, catalogue); });
    }
    if (field.type == FieldType::strategy || field.type == FieldType::strategy_list)
        return is_stochastic(value, field.kind, catalogue);
    return field.object != nullptr && any_stochastic(value, *field.object, catalogue);
}

bool any_stochastic(const ConfigNode& map, const config::Schema& schema,
                    const plugin::Catalogue& catalogue) {
    if (!map.is_map()) return false;
    return std::any_of(map.entries().begin(), map.entries().end(),
                       [&](const config::ConfigEntry& entry) {
                           const Field* field = schema.find(entry.key);
                           return field != nullptr && any_in(entry.value, *field, catalogue);
                       });
}

}  // namespace

bool depends_on_seed(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue) {
    const std::optional<Input>& input = loaded.experiment.input;
    if (input && (input->cloud.sample || input->cloud.vary)) return true;
    return any_stochastic(loaded.resolved, *experiment_schema(), catalogue);
}

}  // namespace dsc::run
