#include "library.hpp"

#include <algorithm>
#include <string>

#include <dlfcn.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/text/words.hpp>

#include "entry_file.hpp"

namespace dsc::host {
namespace {

// Stores what enroll() registers until all of it has been checked.
class Staging : public plugin::Registrar {
public:
    std::vector<plugin::StrategyRecord> records;

protected:
    void enroll(plugin::StrategyRecord record) override {
        const std::string name = fmt::format("{} '{}'", plugin::kind_name(record.kind), record.id);
        if (!text::is_id(record.id)) {
            throw PluginError("plugin.enroll", name, "its id is not of the form [a-z][a-z0-9_]*",
                              "");
        }
        if (record.summary.empty())
            throw PluginError("plugin.enroll", name, "it has no summary", "");
        const bool repeated =
            std::any_of(records.begin(), records.end(), [&record](const auto& other) {
                return other.kind == record.kind && other.id == record.id;
            });
        if (repeated) throw PluginError("plugin.enroll", name, "it is registered twice", "");
        records.push_back(std::move(record));
    }
};

}  // namespace

const plugin::PluginEntry& open_library(const std::filesystem::path& file) {
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    const char* reason = library == nullptr ? dlerror() : nullptr;
    if (library == nullptr) {
        refuse(file, "plugin.load",
               fmt::format("does not load: {}", reason == nullptr ? "no reason given" : reason),
               "a symbol or library that it needs is missing; link with -Wl,-z,defs to find it at "
               "build time");
    }
    const void* entry = dlsym(library, plugin::entry_symbol);
    if (entry == nullptr)
        refuse(file, "plugin.no_entry", "lost its entry while it was loaded", "load it again");
    return *static_cast<const plugin::PluginEntry*>(entry);
}

std::vector<plugin::StrategyRecord> enroll(const plugin::PluginEntry& entry,
                                           const std::filesystem::path& file) {
    const std::string remedy = "report this to the plugin's authors";
    const std::string name = text_of(entry.name);
    if (!text::is_id(name)) {
        refuse(file, "plugin.enroll",
               fmt::format("has the name '{}', which is not of the form [a-z][a-z0-9_]*", name),
               remedy);
    }
    if (entry.enroll == nullptr) refuse(file, "plugin.enroll", "has no enroll function", remedy);
    Staging staging;
    try {
        entry.enroll(staging);
    } catch (const std::exception& error) {
        refuse(file, "plugin.enroll",
               fmt::format("plugin '{}' failed to register: {}", name, error.what()), remedy);
    } catch (...) {
        refuse(file, "plugin.enroll",
               fmt::format("plugin '{}' failed to register: it threw something that is not a "
                           "std::exception",
                           name),
               remedy);
    }
    if (staging.records.empty())
        refuse(file, "plugin.enroll", fmt::format("plugin '{}' registers no strategy", name),
               remedy);
    return std::move(staging.records);
}

}  // namespace dsc::host
