// Validates every point of a sweep as an experiment and reports all faults at once.
#include <map>
#include <set>
#include <string_view>

#include <dsc/base/error.hpp>
#include <dsc/config/diagnostics.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/run/seeds.hpp>
#include <dsc/run/simulation.hpp>
#include <dsc/sweep/sweep.hpp>
#include <dsc/text/words.hpp>

namespace dsc::sweep {
namespace {

namespace fs = std::filesystem;
using config::ConfigNode;

/// The faults of all points. Most belong to one value and occur in every point with this value.
class Faults {
public:
    void add(const Error& error, const SweepPoint& point) {
        only_files_ = only_files_ && error.exit_code() == ExitCode::io;
        for (std::string& text : parts(error.what())) add(std::move(text), point);
    }

    void throw_if_any() const {
        if (list_.empty()) return;
        constexpr std::size_t most_shown = 100;
        std::string text;
        for (std::size_t i = 0; i < list_.size() && i < most_shown; ++i)
            text += list_[i].text + note(list_[i]);
        if (list_.size() > most_shown)
            text += "... and " + std::to_string(list_.size() - most_shown) + " more\n";
        text += text::counted(list_.size(), "error") + "; nothing was written";
        if (only_files_) throw IoError("io.open", text);
        throw ConfigError("config.invalid", text);
    }

private:
    struct Fault {
        std::string text;
        std::string first;  ///< overrides of the first point that has it
        std::size_t points = 1;
    };

    void add(std::string text, const SweepPoint& point) {
        const auto [found, fresh] = places_.try_emplace(text, list_.size());
        if (fresh) {
            list_.push_back({std::move(text), config::flow_text(point.overrides)});
        } else {
            ++list_[found->second].points;
        }
    }

    /// A diagnostic starts at the left margin and continues in indented lines. The last line
    /// contains the number of faults.
    static std::vector<std::string> parts(std::string_view message) {
        const std::size_t end = message.rfind('\n');
        if (end == std::string_view::npos) return {"error: " + std::string(message) + "\n"};
        message = message.substr(0, end + 1);
        std::vector<std::string> all;
        while (!message.empty()) {
            const std::size_t line_end = message.find('\n') + 1;
            if (all.empty() || message.front() != ' ') all.emplace_back();
            all.back() += message.substr(0, line_end);
            message.remove_prefix(line_end);
        }
        return all;
    }

    static std::string note(const Fault& fault) {
        const std::size_t others = fault.points - 1;
        return "      note: in the point " + fault.first +
               (others == 0 ? "" : " and " + text::counted(others, "other")) + "\n";
    }

    std::vector<Fault> list_;
    std::map<std::string, std::size_t> places_;
    bool only_files_ = true;
};

/// Loads plugins once per list of plugins, not once per point.
class Loader {
public:
    explicit Loader(const run::PluginLoader& load) : load_(load) {}
    const config::StrategyLookup& operator()(const std::vector<std::string>& paths) {
        const auto found = loaded_.find(paths);
        if (found != loaded_.end()) return *found->second;
        return *loaded_.emplace(paths, &load_(paths)).first->second;
    }

private:
    const run::PluginLoader& load_;
    std::map<std::vector<std::string>, const config::StrategyLookup*> loaded_;
};

/// The tree with all overrides that fit; the others are faults of the point, and the rest is still
/// checked.
ConfigNode with_all(ConfigNode root, const ConfigNode& overrides, const SweepPoint& point,
                    Faults& faults) {
    if (overrides.is_null()) return root;
    for (const config::ConfigEntry& entry : overrides.entries()) {
        if (entry.key == truth_key) continue;  // it is not part of the experiment
        try {
            root = config::with_value(root, entry.key, entry.value, entry.position);
        } catch (const ConfigError& error) {
            faults.add(error, point);
        }
    }
    return root;
}

/// Reports a truth that does not exist.
void require_truth(const SweepPoint& point) {
    const ConfigNode& file = point.truth.value;
    std::error_code ignored;
    if (file.is_null() || fs::exists(file.as_string(), ignored)) return;
    throw IoError("io.open", config::format({config::Severity::error,
                                             "io.open",
                                             file.position(),
                                             "'truth': " + file.as_string() + " does not exist",
                                             "check the path; it is relative to the folder of this "
                                             "file",
                                             {}}) +
                                 "1 error");
}

/// Repeats of a point are refused if the seed has no influence: they would all be the same.
class Repeats {
public:
    void require_different(const SweepPoint& point, const run::LoadedExperiment& loaded,
                           const plugin::Catalogue& catalogue) {
        const config::ConfigEntry* seed = point.overrides.find_entry("seed");
        if (seed == nullptr) return;
        std::string others;
        for (const config::ConfigEntry& entry : point.overrides.entries()) {
            if (entry.key != "seed")
                others += entry.key + "=" + config::flow_text(entry.value) + "\n";
        }
        if (first_.insert(others).second || run::depends_on_seed(loaded, catalogue)) return;
        const auto& input = loaded.experiment.input;
        config::fail(
            "config.sweep_repeat", seed->value.position(),
            "runs that differ only in their seeds would all be the same: nothing in this "
            "experiment depends on the seed",
            input && input->cloud.file
                ? "set input.cloud.vary: {subsample: 0.9, rotate: true}, so that each seed "
                  "draws a variation of the cloud, or do not repeat"
                : "do not repeat, or use a sampled or varied cloud or a stochastic "
                  "strategy");
    }

private:
    std::set<std::string> first_;  ///< the overrides, except the seed, of the points before
};

}  // namespace

std::vector<std::string> sweep_experiments(const Sweep& sweep,
                                           const run::PluginLoader& load_plugins,
                                           const plugin::Catalogue& catalogue,
                                           const config::YamlOptions& options) {
    ConfigNode base = config::load_yaml(sweep.base, options);
    if (base.is_map() && base.find("name") == nullptr)
        base = base.with("name", ConfigNode(fs::path(sweep.base).stem().string()));

    Loader loader(load_plugins);
    const run::PluginLoader load_once =
        [&loader](const auto& paths) -> const config::StrategyLookup& { return loader(paths); };
    Faults faults;
    Repeats repeats;
    std::set<std::vector<std::string>> read;  // files that were already hashed, because a cloud may
                                              // be large
    std::vector<std::string> texts;
    for (const SweepPoint& point : sweep.points) {
        try {
            const ConfigNode root =
                with_all(with_all(base, sweep.set, point, faults), point.overrides, point, faults);
            const run::LoadedExperiment loaded = run::resolve_experiment(root, load_once);
            run::make_strategies(loaded.experiment, catalogue);
            repeats.require_different(point, loaded, catalogue);
            require_truth(point);
            if (read.insert(run::input_files(loaded, catalogue)).second)
                run::config_hash(loaded, catalogue);
            texts.push_back("# Point " + point.name + " of a sweep: " +
                            config::flow_text(point.overrides) + "\n" + run::resolved_text(loaded));
        } catch (const ConfigError& error) {
            faults.add(error, point);
        } catch (const IoError& error) {
            faults.add(error, point);
        }
    }
    faults.throw_if_any();
    return texts;
}

}  // namespace dsc::sweep
