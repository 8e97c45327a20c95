#include "notes.hpp"

#include <dsc/base/error.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/conformance/check.hpp>

namespace dsc::conformance {
namespace {

namespace fs = std::filesystem;
using config::ConfigNode;

[[noreturn]] void refuse(const ConfigNode& node, const std::string& cause) {
    throw ConfigError("check.notes", node.position().describe() + ": error: " + cause + "\n");
}

void require_known(const ConfigNode& map, std::initializer_list<std::string_view> keys) {
    for (const config::ConfigEntry& entry : map.entries()) {
        bool known = false;
        for (const std::string_view key : keys) known = known || entry.key == key;
        if (!known) refuse(entry.value, "unknown key '" + entry.key + "' in the notes of a plugin");
    }
}

std::map<std::string, std::string> waivers(const ConfigNode& map) {
    std::map<std::string, std::string> result;
    const std::vector<TestInfo> known = tests();
    for (const config::ConfigEntry& entry : map.entries()) {
        bool is_test = false;
        for (const TestInfo& test : known) is_test = is_test || test.id == entry.key;
        if (!is_test) refuse(entry.value, "there is no test '" + entry.key + "' to waive");
        if (entry.value.as_string().empty()) refuse(entry.value, "a waived test needs a reason");
        result[entry.key] = entry.value.as_string();
    }
    return result;
}

StrategyNotes strategy(const ConfigNode& node) {
    require_known(node, {"kind", "id", "parameters", "waive"});
    StrategyNotes notes;
    const auto kind = plugin::find_kind(node.at("kind").as_string());
    if (!kind)
        refuse(node.at("kind"),
               "there is no kind of strategy '" + node.at("kind").as_string() + "'");
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
