#include "notes.hpp"

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/conformance/check.hpp>

namespace dsc::conformance {
namespace {

namespace fs = std::filesystem;
using config::ConfigNode;

[[noreturn]] void refuse(const ConfigNode& node, const std::string& cause,
                         const std::string& remedy) {
    throw ConfigError("check.notes", node.position().describe(), cause, remedy);
}

void require_known(const ConfigNode& map, std::initializer_list<std::string_view> keys) {
    for (const config::ConfigEntry& entry : map.entries()) {
        bool known = false;
        for (const std::string_view key : keys) known = known || entry.key == key;
        if (known) continue;
        refuse(entry.value, fmt::format("unknown key '{}' in the notes of a plugin", entry.key),
               fmt::format("the keys here are {}", fmt::join(keys, ", ")));
    }
}

std::map<std::string, std::string> waivers(const ConfigNode& map) {
    std::map<std::string, std::string> result;
    const std::vector<TestInfo> known = tests();
    for (const config::ConfigEntry& entry : map.entries()) {
        bool is_test = false;
        for (const TestInfo& test : known) is_test = is_test || test.id == entry.key;
        if (!is_test) {
            refuse(entry.value, fmt::format("there is no test '{}' to waive", entry.key),
                   "dsc plugin check --list shows all");
        }
        if (entry.value.as_string().empty()) {
            refuse(entry.value, "a waived test needs a reason",
                   fmt::format("write {}: REASON", entry.key));
        }
        result[entry.key] = entry.value.as_string();
    }
    return result;
}

StrategyNotes strategy(const ConfigNode& node) {
    require_known(node, {"kind", "id", "parameters", "waive"});
    StrategyNotes notes;
    const auto kind = plugin::find_kind(node.at("kind").as_string());
    if (!kind) {
        std::vector<std::string_view> names;
        for (const plugin::Kind known : plugin::all_kinds)
            names.push_back(plugin::kind_name(known));
        refuse(node.at("kind"),
               fmt::format("there is no kind of strategy '{}'", node.at("kind").as_string()),
               fmt::format("the kinds are {}", fmt::join(names, ", ")));
    }
    notes.kind = *kind;
    notes.id = node.at("id").as_string();
    if (const ConfigNode* parameters = node.find("parameters")) notes.parameters = *parameters;
    if (const ConfigNode* waive = node.find("waive")) notes.waive = waivers(*waive);
    return notes;
}

}  // namespace

Notes notes_beside(const fs::path& library) {
    const fs::path file = library.parent_path() / (library.stem().string() + ".check.yaml");
    std::error_code error;
    return fs::exists(file, error) ? read_notes(file) : Notes{};
}

Notes read_notes(const fs::path& file) {
    const ConfigNode root = config::load_yaml(file);
    require_known(root, {"strategies"});
    Notes notes;
    for (const ConfigNode& node : root.at("strategies").items()) notes.push_back(strategy(node));
    return notes;
}

const StrategyNotes* find(const Notes& notes, plugin::Kind kind, const std::string& id) {
    for (const StrategyNotes& n : notes) {
        if (n.kind == kind && n.id == id) return &n;
    }
    return nullptr;
}

}  // namespace dsc::conformance
