#pragma once
// Host: opens plugins, refuses those that do not fit, and owns the registry of their strategies.

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <dsc/host/scan.hpp>
#include <dsc/host/search_path.hpp>
#include <dsc/plugin/catalogue.hpp>

namespace dsc::host {

/// The reaction of load_all to a library that is refused.
enum class OnFault {
    stop_if_required,  ///< throws for entries that the user named, logs a warning for the others
    collect,           ///< never throws; see faults()
};

/// Two hosts in a process are independent of each other. Libraries are never unloaded. One thread
/// at a time. [setup]
class Host : public plugin::Catalogue {
public:
    Host();
    ~Host() override;
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    /// Loads one library. A file that is already loaded is skipped. All or nothing: a refused
    /// library leaves no strategy behind. Throws PluginError naming file, reason and remedy:
    ///
    /// | code | reason |
    /// | --- | --- |
    /// | plugin.open | the file does not exist or cannot be read |
    /// | plugin.writable | others may write the file or its folder |
    /// | plugin.not_elf | not a shared library for this machine, or a damaged one |
    /// | plugin.no_entry | a library without the entry of a dsc plugin |
    /// | plugin.magic, plugin.size, plugin.abi | an entry of another layout or version |
    /// | plugin.fingerprint | another compiler, standard library or options; both are printed |
    /// | plugin.crash, plugin.hang | it crashes or does not load in time |
    /// | plugin.load | the dynamic linker refused it |
    /// | plugin.enroll | enroll threw, or registered nothing or something malformed |
    /// | plugin.duplicate | a strategy's id is taken; both files are named |
    ///
    /// Up to plugin.fingerprint no code of the library has run: the host reads only the file. Then
    /// it is loaded in a child process (scan.hpp), and only a library that loads there without a
    /// fault is loaded into this process.
    ///
    /// A script (plugin::is_script) is checked for who may write it and then run in this process;
    /// its faults are exceptions. Further codes: "plugin.no_python", "plugin.script".
    void load(const std::filesystem::path& file);

    /// Adds strategies that this program defines itself. Throws PluginError "plugin.duplicate".
    void add(plugin::PluginInfo info, std::vector<plugin::StrategyRecord> strategies);

    /// Loads the entries in order. In folders every libdsc_*.so is loaded, in the order of the
    /// names; a name that an earlier entry had is skipped, so that a user's own build is used
    /// instead of an installed one. May be called again with more entries: libraries that are
    /// loaded or were refused already are skipped.
    void load_all(std::span<const SearchEntry> entries,
                  OnFault on_fault = OnFault::stop_if_required);

    /// Libraries that load_all refused.
    const std::vector<Fault>& faults() const noexcept { return faults_; }

    std::optional<plugin::StrategyInfo> find(plugin::Kind kind,
                                             const std::string& id) const override;
    std::vector<plugin::StrategyInfo> list() const override;
    std::vector<plugin::PluginInfo> plugins() const override;

private:
    struct Loaded;
    bool is_loaded(const std::filesystem::path& real) const;
    void load_script(const std::filesystem::path& real);
    void rehearse(std::span<const std::filesystem::path> files);
    void rehearse_folder(const std::set<std::filesystem::path>& files);
    void load_folder(const SearchEntry& entry, OnFault on_fault);
    template <class Load>
    void attempt(const SearchEntry& entry, const std::filesystem::path& file, OnFault on_fault,
                 Load&& load);

    std::vector<std::unique_ptr<Loaded>> loaded_;
    std::map<std::pair<plugin::Kind, std::string>, plugin::StrategyInfo> strategies_;
    /// By real path; nothing: it loaded without a fault.
    std::map<std::filesystem::path, std::optional<Fault>> rehearsed_;
    std::vector<Fault> faults_;
};

}  // namespace dsc::host
