// Loads an experiment: files, overrides, plugins, validation, hash.
#include "dsc/run/experiment.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/run/sha256.hpp>
#include <dsc/text/words.hpp>

namespace dsc::run {
namespace {

namespace fs = std::filesystem;
using config::ConfigEntry;
using config::ConfigNode;
using config::Field;
using config::FieldType;
using config::Schema;
using config::StrategyLookup;

/// The folder to which relative names in `node` refer.
fs::path folder_of(const ConfigNode& node) {
    const config::SourcePosition& position = node.position();
    if (!position.known() || position.from_command_line()) return fs::current_path();
    return fs::absolute(position.source->name).parent_path();
}

/// Reads `plugins:` before the validation; wrong types are reported later by the schema.
std::vector<std::string> plugin_paths(const ConfigNode& root) {
    std::vector<std::string> paths;
    const ConfigNode* list = root.find("plugins");
    if (list == nullptr || !list->is_list()) return paths;
    const Field& field = *experiment_schema()->find("plugins");
    for (const ConfigNode& given : list->items()) {
        const ConfigNode& item = field.text_of(given);
        if (!item.is_string()) continue;
        paths.push_back((folder_of(item) / item.as_string()).lexically_normal().string());
    }
    return paths;
}

using FileChange = std::function<ConfigNode(const ConfigNode& file)>;

/// Replaces the value of every file field that is set by `change(value)`, also in nested objects
/// and strategies.
ConfigNode map_files(const ConfigNode& node, const Schema& schema, const StrategyLookup& lookup,
                     const FileChange& change);

ConfigNode map_strategy(const ConfigNode& node, const std::string& kind,
                        const StrategyLookup& lookup, const FileChange& change) {
    const ConfigNode* type = node.find("type");
    if (type == nullptr || !type->is_string()) return node;
    const Schema* schema = lookup.find_schema(kind, type->as_string());
    return schema == nullptr ? node : map_files(node, *schema, lookup, change);
}

ConfigNode map_value(const ConfigNode& value, const Field& field, const StrategyLookup& lookup,
                     const FileChange& change) {
    if (value.is_null()) return value;
    std::vector<ConfigNode> items;
    switch (field.type) {
        case FieldType::file: return value.as_string().empty() ? value : change(value);
        case FieldType::object: return map_files(value, *field.object, lookup, change);
        case FieldType::strategy: return map_strategy(value, field.kind, lookup, change);
        case FieldType::object_list:
            for (const ConfigNode& item : value.items())
                items.push_back(map_files(item, *field.object, lookup, change));
            return ConfigNode::list(std::move(items));
        case FieldType::strategy_list:
            for (const ConfigNode& item : value.items())
                items.push_back(map_strategy(item, field.kind, lookup, change));
            return ConfigNode::list(std::move(items));
        default: return value;
    }
}

ConfigNode map_files(const ConfigNode& node, const Schema& schema, const StrategyLookup& lookup,
                     const FileChange& change) {
    std::vector<ConfigEntry> entries;
    for (const ConfigEntry& entry : node.entries()) {
        const Field* field = schema.find(entry.key);
        entries.emplace_back(entry.key, field == nullptr
                                            ? entry.value
                                            : map_value(entry.value, *field, lookup, change));
    }
    return ConfigNode::map(std::move(entries));
}

/// Content of a plugin path: the hash of a library, or the hashes of all libraries of a folder in
/// the order of their names.
ConfigNode plugin_content(const std::string& path, InputFiles& known) {
    std::vector<fs::path> files;
    if (fs::is_directory(path)) {
        for (const auto& entry : fs::directory_iterator(path)) {
            if (entry.path().extension() == ".so") files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end());
    } else {
        files.emplace_back(path);
    }
    std::vector<ConfigNode> hashes;
    for (const fs::path& file : files) hashes.emplace_back("sha256:" + known.sha256(file));
    return ConfigNode::list(std::move(hashes));
}

/// Reports all missing files at once, each at its place.
void require_files(const ConfigNode& resolved, const StrategyLookup& lookup,
                   const InputFiles& known) {
    config::Diagnostics missing;
    map_files(resolved, *experiment_schema(), lookup, [&](const ConfigNode& file) {
        const bool typed = file.position().from_command_line();
        if (!known.exists(file.as_string())) {
            missing.error("io.open", file.position(),
                          fmt::format("'{}': {} does not exist", file.path(), file.as_string()),
                          fmt::format("check the path; it is relative to the {}",
                                      typed ? "current folder" : "folder of this file"));
        }
        return file;
    });
    if (!missing.has_errors()) return;
    throw IoError("io.open", missing.text(config::Severity::error) +
                                 text::counted(missing.error_count(), "error") +
                                 "; nothing was run");
}

}  // namespace

LoadedExperiment resolve_experiment(const ConfigNode& root, const PluginLoader& load_plugins) {
    const std::vector<std::string> plugins = plugin_paths(root);
    const StrategyLookup& lookup = load_plugins(plugins);
    config::Diagnostics diagnostics;
    const std::shared_ptr<const Schema> schema = experiment_schema();
    LoadedExperiment loaded;
    loaded.resolved = config::validate(root, *schema, lookup, diagnostics);
    diagnostics.throw_if_errors();

    if (const ConfigNode* list = loaded.resolved.find("plugins");
        list != nullptr && list->is_list()) {
        for (std::size_t i = 0; i < list->size(); ++i) {
            loaded.resolved = loaded.resolved.with(
                "plugins", loaded.resolved.at("plugins").with_item(i, ConfigNode(plugins.at(i))));
        }
    }
    config::ParamSchema<Experiment> reader;
    Experiment::declare(reader);
    loaded.experiment = reader.read(loaded.resolved);
    loaded.warnings = diagnostics.text(config::Severity::warning);
    return loaded;
}

ConfigNode read_experiment(const std::string& file, std::span<const std::string> overrides,
                           const config::YamlOptions& options) {
    ConfigNode root = config::load_yaml(file, options);
    root = config::apply_overrides(root, overrides, options);
    if (root.is_map() && root.find("name") == nullptr) {
        root = root.with("name", ConfigNode(fs::path(file).stem().string()));
    }
    return root;
}

LoadedExperiment load_experiment(const std::string& file, std::span<const std::string> overrides,
                                 const PluginLoader& load_plugins,
                                 const config::YamlOptions& options) {
    return resolve_experiment(read_experiment(file, overrides, options), load_plugins);
}

std::string resolved_text(const LoadedExperiment& loaded) {
    return config::to_yaml(loaded.resolved);
}

std::string config_hash(const LoadedExperiment& loaded, const StrategyLookup& lookup) {
    require_files(loaded.resolved, lookup, *loaded.files);
    ConfigNode canonical =
        map_files(loaded.resolved, *experiment_schema(), lookup, [&loaded](const ConfigNode& file) {
            return ConfigNode("sha256:" + loaded.files->sha256(file.as_string()));
        });
    std::vector<ConfigNode> plugins;
    for (const std::string& path : loaded.experiment.plugins)
        plugins.push_back(plugin_content(path, *loaded.files));
    canonical = canonical.with("plugins", ConfigNode::list(std::move(plugins)));
    return sha256(config::to_yaml(canonical));
}

std::vector<std::string> input_files(const LoadedExperiment& loaded, const StrategyLookup& lookup) {
    std::vector<std::string> files;
    map_files(loaded.resolved, *experiment_schema(), lookup, [&](const ConfigNode& file) {
        const std::string& name = file.as_string();
        if (std::find(files.begin(), files.end(), name) == files.end()) files.push_back(name);
        return file;
    });
    return files;
}

}  // namespace dsc::run
