// Compares the plugins and files of an experiment with those of an earlier run.
#include "contents.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace dsc::run {
namespace {

namespace fs = std::filesystem;
using config::ConfigNode;
using config::Field;
using config::FieldType;
using config::Schema;
using nlohmann::json;

/// Collects the strategies of a resolved configuration.
class Collector {
public:
    Collector(const LoadedExperiment& loaded, const plugin::Catalogue& catalogue)
        : loaded_(loaded), catalogue_(catalogue) {}

    std::vector<UsedStrategy> collect() {
        fields(loaded_.resolved, *experiment_schema());
        return std::move(found_);
    }

private:
    void fields(const ConfigNode& node, const Schema& schema) {
        for (const Field& field : schema.fields()) {
            const ConfigNode* given = node.find(field.name);
            if (given != nullptr && !given->is_null()) value(*given, field);
        }
    }

    void value(const ConfigNode& given, const Field& field) {
        switch (field.type) {
            case FieldType::object: return fields(given, *field.object);
            case FieldType::strategy: return strategy(given, field.kind);
            case FieldType::object_list:
                for (const ConfigNode& item : given.items()) fields(item, *field.object);
                return;
            case FieldType::strategy_list:
                for (const ConfigNode& item : given.items()) strategy(item, field.kind);
                return;
            default: return;
        }
    }

    void strategy(const ConfigNode& node, const std::string& kind) {
        const std::string id = node.at("type").as_string();
        const auto known = plugin::find_kind(kind);
        const auto info = known ? catalogue_.find(*known, id) : std::nullopt;
        if (!info) return;
        const bool again =
            std::any_of(found_.begin(), found_.end(), [&](const UsedStrategy& strategy) {
                return strategy.kind == kind && strategy.id == id;
            });
        if (!again) {
            const plugin::PluginInfo& plugin = *info->plugin;
            found_.push_back(
                {kind, id, plugin.file, loaded_.files->sha256(plugin.file), plugin.installed});
        }
        fields(node, *info->strategy->schema);
    }

    const LoadedExperiment& loaded_;
    const plugin::Catalogue& catalogue_;
    std::vector<UsedStrategy> found_;
};

/// The hash under `key` in the entry, or nothing.
std::string hash_in(const json& entry) {
    const auto found = entry.find("sha256");
    return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Whether `plugins:` names the library or its folder.
bool is_named(const plugin::PluginInfo& plugin, const Experiment& experiment) {
    return std::any_of(experiment.plugins.begin(), experiment.plugins.end(),
                       [&plugin](const std::string& path) {
                           std::error_code error;
                           return fs::equivalent(path, plugin.file, error) ||
                                  fs::equivalent(path, plugin.file.parent_path(), error);
                       });
}

json list_in(const json& root, const char* key) {
    const auto found = root.is_object() ? root.find(key) : root.end();
    return found != root.end() && found->is_array() ? *found : json::array();
}

void add(std::string& names, const std::string& name) {
    names += (names.empty() ? "" : ", ") + name;
}

}  // namespace

std::vector<UsedStrategy> used_strategies(const LoadedExperiment& loaded,
                                          const plugin::Catalogue& catalogue) {
    return Collector(loaded, catalogue).collect();
}

std::vector<UsedStrategy> changed_strategies(const std::vector<UsedStrategy>& used,
                                             const RunFolder::Status& status) {
    std::vector<UsedStrategy> changed;
    for (const UsedStrategy& strategy : used) {
        const auto there = status.strategies.find(strategy.key());
        if (there != status.strategies.end() && there->second != strategy.sha256)
            changed.push_back(strategy);
    }
    return changed;
}

std::string text_of(const std::vector<UsedStrategy>& strategies) {
    std::string text;
    for (const UsedStrategy& s : strategies)
        add(text, fmt::format("{}, which provides {} '{}'", s.file.string(), s.kind, s.id));
    return text;
}

std::string changed_files(const fs::path& folder, const LoadedExperiment& loaded,
                          const plugin::Catalogue& catalogue) {
    std::ifstream file(folder / "provenance.json");
    const json root = file ? json::parse(file, nullptr, false) : json();
    const json inputs = list_in(root, "inputs"), plugins = list_in(root, "plugins");
    std::string names;
    const std::vector<std::string> files = input_files(loaded, catalogue);
    for (std::size_t i = 0; i < files.size() && files.size() == inputs.size(); ++i) {
        if (hash_in(inputs[i]) != loaded.files->sha256(files[i])) add(names, files[i]);
    }
    for (const plugin::PluginInfo& plugin : catalogue.plugins()) {
        if (!is_named(plugin, loaded.experiment)) continue;
        const std::string& hash = loaded.files->sha256(plugin.file);
        const bool same = std::any_of(plugins.begin(), plugins.end(), [&hash](const json& entry) {
            return hash_in(entry) == hash;
        });
        if (root.is_object() && !same) add(names, plugin.file.string());
    }
    return names;
}

}  // namespace dsc::run
