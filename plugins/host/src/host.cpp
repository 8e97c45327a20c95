#include "dsc/host/host.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/plugin/guarded.hpp>
#include <dsc/plugin/script_loader.hpp>

#include "admission.hpp"
#include "entry_file.hpp"
#include "library.hpp"

namespace dsc::host {
namespace {

namespace fs = std::filesystem;

bool is_library_name(const std::string& name) {
    constexpr std::string_view head = "libdsc_";
    constexpr std::string_view tail = ".so";
    return name.size() > head.size() + tail.size() && name.compare(0, head.size(), head) == 0 &&
           name.compare(name.size() - tail.size(), tail.size(), tail) == 0;
}

plugin::PluginInfo info_of(const plugin::PluginEntry& entry, const fs::path& file) {
    std::error_code error;
    return {text_of(entry.name),
            text_of(entry.version),
            text_of(entry.license),
            text_of(entry.summary),
            text_of(entry.authors),
            text_of(entry.fingerprint),
            file,
            fs::equivalent(file.parent_path(), installed_folder(), error)};
}

fs::path script_library() { return library_folder() / "libdsc_python.so"; }

// Beside the core library, or one level above it where the libraries of an architecture have a
// folder of their own, as in Debian's packages.
fs::path script_modules() {
    const fs::path modules = fs::path("python3") / "dist-packages";
    std::error_code error;
    const fs::path beside = library_folder() / modules;
    if (fs::is_directory(beside / "dsc", error)) return beside;
    return library_folder().parent_path() / modules;
}

void log_soft_differences(const plugin::PluginInfo& info) {
    for (const auto& d :
         plugin::compare_fingerprints(info.fingerprint, plugin::core_fingerprint())) {
        log(LogLevel::debug, fmt::format("{}: {} is '{}', that of dsc is '{}'", info.file.string(),
                                         d.key, d.plugin, d.host));
    }
}

}  // namespace

struct Host::Loaded {
    plugin::PluginInfo info;
    std::vector<plugin::StrategyRecord> strategies;
};

Host::Host() = default;
Host::~Host() = default;

void Host::rehearse(std::span<const fs::path> files) {
    const auto faults = scan(files);
    for (std::size_t i = 0; i < files.size(); ++i) rehearsed_[files[i]] = faults[i];
}

// One child process for a whole folder. Libraries that do not pass the gate here are refused and
// reported later, in their order.
void Host::rehearse_folder(const std::set<fs::path>& files) {
    std::vector<fs::path> admissible;
    for (const fs::path& file : files) {
        try {
            const fs::path real = real_path(file);
            if (is_loaded(real) || rehearsed_.count(real) != 0) continue;
            require_admissible(real);
            admissible.push_back(real);
        } catch (const PluginError&) {
            continue;
        }
    }
    if (!admissible.empty()) rehearse(admissible);
}

bool Host::is_loaded(const fs::path& real) const {
    return std::any_of(loaded_.begin(), loaded_.end(),
                       [&real](const auto& loaded) { return loaded->info.file == real; });
}

void Host::load(const fs::path& file) {
    const fs::path real = real_path(file);
    if (is_loaded(real)) return;
    if (plugin::is_script(real)) return load_script(real);
    if (rehearsed_.count(real) == 0) {
        require_admissible(real);
        rehearse({&real, 1});
    }
    if (const std::optional<Fault>& fault = rehearsed_.at(real)) throw fault->error;

    const plugin::PluginEntry& entry = open_library(real);
    add(info_of(entry, real), enroll(entry, real));
    log_soft_differences(loaded_.back()->info);
}

// A fault of a script is an exception, so it needs no child process; a crash, an exit or a script
// that never ends is reported with its name.
void Host::load_script(const fs::path& real) {
    require_safe_file(real);
    plugin::Identity who;
    who.file = real.string();
    const plugin::Call call{who, "the import", std::nullopt};
    const plugin::Inside inside(call);
    Script script = run_script(real, script_library(), script_modules());
    add(std::move(script.info), std::move(script.strategies));
}

void Host::add(plugin::PluginInfo info, std::vector<plugin::StrategyRecord> strategies) {
    auto loaded = std::make_unique<Loaded>(Loaded{std::move(info), std::move(strategies)});
    for (const plugin::StrategyRecord& record : loaded->strategies) {
        const auto taken = strategies_.find({record.kind, record.id});
        if (taken == strategies_.end()) continue;
        refuse(loaded->info.file, "plugin.duplicate",
               fmt::format("{} '{}' already exists, from {}", plugin::kind_name(record.kind),
                           record.id, taken->second.plugin->file.string()),
               "load only one of the two files, or give one strategy a different id");
    }
    for (const plugin::StrategyRecord& record : loaded->strategies) {
        strategies_[{record.kind, record.id}] = {&record, &loaded->info};
    }
    loaded_.push_back(std::move(loaded));
}

template <class Load>
void Host::attempt(const SearchEntry& entry, const fs::path& file, OnFault on_fault, Load&& load) {
    try {
        load();
    } catch (const PluginError& error) {
        // Two strategies with the same id are an error in any order.
        const bool fatal = entry.required || error.code() == "plugin.duplicate";
        if (on_fault == OnFault::stop_if_required && fatal) {
            throw PluginError(error.code(), fmt::format("{}: {}", entry.origin, error.place()),
                              error.cause(), error.remedy());
        }
        const bool known = std::any_of(faults_.begin(), faults_.end(),
                                       [&file](const Fault& fault) { return fault.file == file; });
        if (known) return;
        faults_.push_back({file, error});
        if (on_fault == OnFault::stop_if_required)
            log(LogLevel::warning, fmt::format("{}: {}", entry.origin, error.what()));
    }
}

void Host::load_folder(const SearchEntry& entry, OnFault on_fault) {
    std::set<fs::path> files;  // sorted, so that the order in the file system has no influence
    attempt(entry, entry.path, on_fault, [&] {
        require_safe_folder(entry.path);
        std::error_code error;
        for (const auto& item : fs::directory_iterator(entry.path, error)) {
            if (is_library_name(item.path().filename().string())) files.insert(item.path());
        }
        if (error) {
            refuse(entry.path, "plugin.open", fmt::format("cannot be listed ({})", error.message()),
                   "check its permissions");
        }
    });
    rehearse_folder(files);
    std::error_code error;
    for (const fs::path& file : files) {
        const auto earlier =
            std::find_if(loaded_.begin(), loaded_.end(), [&file](const auto& loaded) {
                return loaded->info.file.filename() == file.filename();
            });
        if (earlier != loaded_.end()) {
            const fs::path& front = (*earlier)->info.file;
            if (!fs::equivalent(front, file, error)) {
                log(LogLevel::info,
                    fmt::format(
                        "using {}; {} is ignored (same file name, later on the search path)",
                        front.string(), file.string()));
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
