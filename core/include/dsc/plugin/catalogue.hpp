#pragma once
// Catalogue: all strategies of a host, and how to create one. Setup: what a strategy's constructor
// receives.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/config/params.hpp>
#include <dsc/plugin/registrar.hpp>

namespace dsc::plugin {

/// A loaded plugin.
struct PluginInfo {
    std::string name;
    std::string version;
    std::string license;
    std::string summary;
    std::string authors;
    std::string fingerprint;
    std::filesystem::path file;  ///< without symbolic links
    bool installed = false;      ///< from the folder beside the core library
};

/// A strategy and the plugin that contains it; both live as long as the catalogue.
struct StrategyInfo {
    const StrategyRecord* strategy = nullptr;
    const PluginInfo* plugin = nullptr;
};

/// The host implements it; all other code uses only this interface.
class Catalogue : public config::StrategyLookup {
public:
    ~Catalogue() override;

    /// Empty if the kind has no such id. [setup]
    virtual std::optional<StrategyInfo> find(Kind kind, const std::string& id) const = 0;
    /// All strategies, sorted by kind and id. [setup]
    virtual std::vector<StrategyInfo> list() const = 0;
    /// All plugins in the order in which they were loaded. [setup]
    virtual std::vector<PluginInfo> plugins() const = 0;

    /// nullptr for an unknown kind or id. [setup]
    const config::Schema* find_schema(const std::string& kind,
                                      const std::string& id) const override;
    /// Sorted; empty for an unknown kind. [setup]
    std::vector<std::string> ids(const std::string& kind) const override;

    /// Creates the strategy `config.type` with its parameters; missing parameters get their
    /// defaults. `path` is its place in the experiment ("velocity", "velocity.curvature"); messages
    /// name it and random streams depend on it.
    ///
    /// The result is guarded: whatever the strategy throws or returns wrongly becomes a
    /// StrategyError that names it (see guarded.hpp), and its contexts contain its own instance
    /// number. Throws PluginError "plugin.unknown_strategy", ConfigError for wrong parameters,
    /// StrategyError. [setup]
    template <class Hook>
    std::unique_ptr<Hook> create(const config::StrategyConfig& config,
                                 const std::string& path) const {
        return std::unique_ptr<Hook>(
            static_cast<Hook*>(create(kind_of<Hook>(), config, path).release()));
    }
    std::unique_ptr<hooks::Strategy> create(Kind kind, const config::StrategyConfig& config,
                                            const std::string& path) const;
};

/// Passed to a strategy's constructor. [setup]
class Setup {
public:
    Setup(const Catalogue& catalogue, std::string path);

    /// Place in the experiment.
    const std::string& path() const noexcept { return path_; }
    /// The number of this place; the random streams depend on it.
    std::uint64_t instance() const noexcept { return instance_; }

    /// Creates a nested strategy; `name` is the parameter that contains it. nullptr if `config` is
    /// empty. Throws as Catalogue::create.
    template <class Hook>
    std::unique_ptr<Hook> create(std::string_view name,
                                 const config::StrategyConfig& config) const {
        if (config.empty()) return nullptr;
        return catalogue_->create<Hook>(config, config::join_path(path_, name));
    }

private:
    const Catalogue* catalogue_;
    std::string path_;
    std::uint64_t instance_;
};

}  // namespace dsc::plugin
