#include <dlfcn.h>

#include <algorithm>
#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/host/host.hpp>
#include <dsc/plugin/entry.hpp>
#include <set>

#include "entry_file.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;

bool is_plain_name(std::string_view name) {
    return !name.empty() && name[0] >= 'a' && name[0] <= 'z' &&
           std::all_of(name.begin(), name.end(),
                       [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

bool is_library_name(const std::string& name) {
    constexpr std::string_view head = "libdsc_";
    constexpr std::string_view tail = ".so";
    return name.size() > head.size() + tail.size() && name.compare(0, head.size(), head) == 0 &&
           name.compare(name.size() - tail.size(), tail.size(), tail) == 0;
}

// Loading a library is running it: nobody else may be able to put one there. A sticky folder (as /tmp)
// protects a file that the user names, but not what a scan of it would find.
void require_unwritable(const fs::path& path, bool sticky_will_do) {
    std::error_code error;
    const fs::perms permissions = fs::status(path, error).permissions();
    if (error || (permissions & fs::perms::others_write) == fs::perms::none) return;
    if (sticky_will_do && (permissions & fs::perms::sticky_bit) != fs::perms::none) return;
    refuse(path, "plugin.writable", "may be written by everyone, and loading a plugin runs it",
           "take the permission away (chmod o-w) or move the plugin to a folder of your own");
}

// The folder beside the core library: whoever may write there may as well replace the program, so a judgement
// of it would only stop builds made with a permissive umask.
bool as_trusted_as_the_program(const fs::path& folder) {
    std::error_code error;
    return fs::equivalent(folder, installed_folder(), error);
}

fs::path real_path(const fs::path& file) {
    std::error_code error;
    fs::path real = fs::canonical(file, error);
    if (error)
        refuse(file, "plugin.open", "cannot be opened (" + error.message() + ")",
               "check the name and the permissions");
    return real;
}

const plugin::PluginEntry* open_library(const fs::path& file) {
    // NODELETE, and no dlclose anywhere: virtual tables, exceptions and statics of a plugin stay valid to the
    // end.
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    const char* reason = library == nullptr ? dlerror() : nullptr;
    if (library == nullptr) {
        refuse(file, "plugin.load",
               std::string("does not load: ") + (reason == nullptr ? "no reason given" : reason),
               "a symbol or library that it needs is missing; link with -Wl,-z,defs to see it when building");
    }
    const void* entry = dlsym(library, plugin::entry_symbol);
    if (entry == nullptr)
        refuse(file, "plugin.no_entry", "lost its entry while it was loaded", "load it again");
    return static_cast<const plugin::PluginEntry*>(entry);
}

// Holds what enroll() registers until all of it is known to be sound.
class Staging : public plugin::Registrar {
public:
    std::vector<plugin::StrategyRecord> records;

protected:
    void enroll(plugin::StrategyRecord record) override {
        const std::string name = std::string(plugin::kind_name(record.kind)) + " '" + record.id + "'";
        if (!is_plain_name(record.id)) {
            throw PluginError("plugin.enroll", "the id of " + name + " is not of the form [a-z][a-z0-9_]*");
        }
        if (record.summary.empty()) throw PluginError("plugin.enroll", name + " has no summary");
        const bool repeated = std::any_of(records.begin(), records.end(), [&record](const auto& other) {
            return other.kind == record.kind && other.id == record.id;
        });
        if (repeated) throw PluginError("plugin.enroll", name + " is registered twice");
        records.push_back(std::move(record));
    }
};

std::vector<plugin::StrategyRecord> enroll(const plugin::PluginEntry& entry, const fs::path& file) {
    const std::string remedy = "report this to the plugin's authors";
    const std::string name = text_of(entry.name);
    if (!is_plain_name(name)) {
        refuse(file, "plugin.enroll", "names itself '" + name + "', which is not of the form [a-z][a-z0-9_]*",
               remedy);
    }
    if (entry.enroll == nullptr) refuse(file, "plugin.enroll", "has no enroll function", remedy);
    Staging staging;
    try {
        entry.enroll(staging);
    } catch (const std::exception& error) {
        refuse(file, "plugin.enroll", "plugin '" + name + "' failed to register: " + error.what(), remedy);
    } catch (...) {
        refuse(file, "plugin.enroll", "plugin '" + name + "' failed to register: it threw no std::exception",
               remedy);
    }
    if (staging.records.empty())
        refuse(file, "plugin.enroll", "plugin '" + name + "' registers no strategy", remedy);
    return std::move(staging.records);
}

plugin::PluginInfo info_of(const plugin::PluginEntry& entry, const fs::path& file) {
    return {text_of(entry.name),
            text_of(entry.version),
            text_of(entry.license),
            text_of(entry.summary),
            text_of(entry.authors),
            text_of(entry.fingerprint),
            file};
}

void log_soft_differences(const plugin::PluginInfo& info) {
    for (const auto& d : plugin::compare_fingerprints(info.fingerprint, plugin::core_fingerprint())) {
        log(LogLevel::debug,
            info.file.string() + ": " + d.key + " is '" + d.plugin + "', that of dsc is '" + d.host + "'");
    }
}

}  // namespace

struct Host::Loaded {
    plugin::PluginInfo info;
    std::vector<plugin::StrategyRecord> strategies;
};

Host::Host() = default;
Host::~Host() = default;

void Host::load(const fs::path& file) {
    const fs::path real = real_path(file);
    for (const auto& loaded : loaded_) {
        if (loaded->info.file == real) return;
    }
    if (!as_trusted_as_the_program(real.parent_path())) {
        require_unwritable(real, false);
        require_unwritable(real.parent_path(), true);
    }
    require_fitting(read_entry(real), real);

    const plugin::PluginEntry& entry = *open_library(real);
    auto loaded = std::make_unique<Loaded>(Loaded{info_of(entry, real), enroll(entry, real)});
    for (const plugin::StrategyRecord& record : loaded->strategies) {
        const auto taken = strategies_.find({record.kind, record.id});
        if (taken == strategies_.end()) continue;
        refuse(real, "plugin.duplicate",
               std::string(plugin::kind_name(record.kind)) + " '" + record.id + "' is already there, from " +
                   taken->second.plugin->file.string(),
               "load only one of the two files, or give one strategy another id");
    }
    for (const plugin::StrategyRecord& record : loaded->strategies) {
        strategies_[{record.kind, record.id}] = {&record, &loaded->info};
    }
    log_soft_differences(loaded->info);
    loaded_.push_back(std::move(loaded));
}

template <class Load>
void Host::attempt(const SearchEntry& entry, const fs::path& file, OnFault on_fault, Load&& load) {
    try {
        load();
    } catch (const PluginError& error) {
        // Two answers to one name are never a matter of order.
        const bool fatal = entry.required || error.code() == "plugin.duplicate";
        if (on_fault == OnFault::stop_if_required && fatal) {
            throw PluginError(error.code(), entry.origin + ": " + error.what());
        }
        const bool known = std::any_of(faults_.begin(), faults_.end(),
                                       [&file](const Fault& fault) { return fault.file == file; });
        if (known) return;
        faults_.push_back({file, error.code(), error.what()});
        if (on_fault == OnFault::stop_if_required) log(LogLevel::warning, entry.origin + ": " + error.what());
    }
}

void Host::load_folder(const SearchEntry& entry, OnFault on_fault) {
    std::set<fs::path> files;  // sorted, so that no order of the file system matters
    attempt(entry, entry.path, on_fault, [&] {
        if (!as_trusted_as_the_program(entry.path)) require_unwritable(entry.path, false);
        std::error_code error;
        for (const auto& item : fs::directory_iterator(entry.path, error)) {
            if (is_library_name(item.path().filename().string())) files.insert(item.path());
        }
        if (error) {
            refuse(entry.path, "plugin.open", "cannot be listed (" + error.message() + ")",
                   "check its permissions");
        }
    });
    std::error_code error;
    for (const fs::path& file : files) {
        const auto earlier = std::find_if(loaded_.begin(), loaded_.end(), [&file](const auto& loaded) {
            return loaded->info.file.filename() == file.filename();
        });
        if (earlier != loaded_.end()) {
            const fs::path& front = (*earlier)->info.file;
            if (!fs::equivalent(front, file, error)) {
                log(LogLevel::info, front.string() + " stands in front of " + file.string());
            }
            continue;
        }
        attempt(entry, file, on_fault, [&] { load(file); });
    }
}

void Host::load_all(std::span<const SearchEntry> entries, OnFault on_fault) {
    for (const SearchEntry& entry : entries) {
        std::error_code error;
        if (fs::is_directory(entry.path, error)) {
            load_folder(entry, on_fault);
        } else {
            attempt(entry, entry.path, on_fault, [&] { load(entry.path); });
        }
    }
}

std::optional<plugin::StrategyInfo> Host::find(plugin::Kind kind, const std::string& id) const {
    const auto found = strategies_.find({kind, id});
    return found == strategies_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<plugin::StrategyInfo> Host::list() const {
    std::vector<plugin::StrategyInfo> all;
    for (const auto& item : strategies_) all.push_back(item.second);
    return all;
}

std::vector<plugin::PluginInfo> Host::plugins() const {
    std::vector<plugin::PluginInfo> all;
    for (const auto& loaded : loaded_) all.push_back(loaded->info);
    return all;
}

}  // namespace dsc::host
