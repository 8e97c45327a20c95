#include "library.hpp"

#include <algorithm>
#include <string>

#include <dlfcn.h>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/host/search_path.hpp>
#include <dsc/plugin/script_loader.hpp>
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

// The libraries of Python's own modules look for its functions among the global symbols.
void start_scripts(const std::filesystem::path& file, const std::filesystem::path& library,
                   const std::filesystem::path& modules) {
    void* const opened = dlopen(library.c_str(), RTLD_NOW | RTLD_GLOBAL | RTLD_NODELETE);
    if (opened == nullptr) {
        refuse(file, "plugin.no_python",
               "is a Python file, and this dsc cannot run Python (" + dl_reason() + ")",
               "build dsc with DSC_PYTHON=ON, which needs python3-dev, python3-numpy and "
               "pybind11-dev");
    }
    using Start = void (*)(const char* modules);
    const auto start = reinterpret_cast<Start>(dlsym(opened, "dsc_start_python"));
    if (start == nullptr)
        refuse(file, "plugin.no_python", library.string() + " has no function dsc_start_python",
               "install dsc again");
    start(modules.c_str());
}

void require_strategies(const Staging& staging, const std::filesystem::path& file,
                        const std::string& name) {
    if (!staging.records.empty()) return;
    refuse(file, "plugin.enroll", "plugin '" + name + "' registers no strategy",
           "report this to the plugin's authors");
}

}  // namespace

std::filesystem::path library_folder() { return installed_folder().parent_path().parent_path(); }

std::string dl_reason() {
    const char* reason = dlerror();
    return reason == nullptr ? "no reason given" : reason;
}

const plugin::PluginEntry& open_library(const std::filesystem::path& file) {
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (library == nullptr) {
        refuse(file, "plugin.load", "does not load: " + dl_reason(),
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
    require_strategies(staging, file, name);
    return std::move(staging.records);
}

Script run_script(const std::filesystem::path& file, const std::filesystem::path& library,
                  const std::filesystem::path& modules) {
    if (plugin::script_loader() == nullptr) start_scripts(file, library, modules);
    const std::shared_ptr<plugin::ScriptLoader> loader = plugin::script_loader();
    if (loader == nullptr)
        refuse(file, "plugin.no_python", library.string() + " registers no loader of scripts",
               "install dsc again");
    Staging staging;
    Script script{loader->load(file, staging), {}};
    require_strategies(staging, file, script.info.name);
    script.strategies = std::move(staging.records);
    return script;
}

}  // namespace dsc::host
