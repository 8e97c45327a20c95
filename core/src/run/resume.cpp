// Decides whether a run can continue in a folder.
#include "resume.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/run/run_folder.hpp>

namespace dsc::run {
namespace {

namespace fs = std::filesystem;
using config::ConfigEntry;
using config::ConfigNode;

constexpr std::string_view remedy_of_resume =
    "run without --resume to start again there, or name another folder with -o";

/// The places where two trees differ.
class Comparison {
public:
    void compare(const ConfigNode* there, const ConfigNode* here, const std::string& path) {
        if (there != nullptr && here != nullptr && *there == *here) return;
        if (there != nullptr && here != nullptr && there->is_map() && here->is_map())
            return maps(*there, *here, path);
        if (there != nullptr && here != nullptr && there->is_list() && here->is_list())
            return lists(*there, *here, path);
        found_.push_back(fmt::format("{} is {} there and {} here", path, text(there), text(here)));
    }

    std::string told() const {
        constexpr std::size_t most = 3;
        std::string all;
        for (std::size_t i = 0; i < std::min(most, found_.size()); ++i)
            all += (i > 0 ? ", " : "") + found_[i];
        if (found_.size() > most) all += fmt::format(", and {} more", found_.size() - most);
        return all;
    }

private:
    static std::string text(const ConfigNode* node) {
        if (node == nullptr) return "not given";
        constexpr std::size_t longest = 60;
        const std::string whole = config::flow_text(*node);
        return whole.size() <= longest ? whole : whole.substr(0, longest) + "...";
    }

    static std::string below(const std::string& path, const std::string& key) {
        return path.empty() ? key : path + "." + key;
    }

    void maps(const ConfigNode& there, const ConfigNode& here, const std::string& path) {
        for (const ConfigEntry& entry : there.entries())
            compare(&entry.value, here.find(entry.key), below(path, entry.key));
        for (const ConfigEntry& entry : here.entries()) {
            if (there.find(entry.key) == nullptr)
                compare(nullptr, &entry.value, below(path, entry.key));
        }
    }

    void lists(const ConfigNode& there, const ConfigNode& here, const std::string& path) {
        for (std::size_t i = 0; i < std::max(there.size(), here.size()); ++i) {
            compare(i < there.size() ? &there.at(i) : nullptr,
                    i < here.size() ? &here.at(i) : nullptr, below(path, std::to_string(i)));
        }
    }

    std::vector<std::string> found_;
};

std::string difference_to(const fs::path& folder, const LoadedExperiment& loaded,
                          const plugin::Catalogue& catalogue) {
    const fs::path file = folder / "config.resolved.yaml";
    try {
        // The values are final: `${` is ordinary text. The same writer made both texts, so equal
        // numbers have equal texts.
        config::YamlOptions options;
        options.environment = [](const std::string&) { return std::optional<std::string>(); };
        const std::string told = experiment_differences(
            config::parse_yaml(read_file(file), file.string(), options),
            config::parse_yaml(resolved_text(loaded), "the experiment", options));
        if (!told.empty()) return told;
        const std::string files = changed_files(folder, loaded, catalogue);
        return fmt::format("the content of {} has changed",
                           files.empty() ? "a file or a plugin that it names" : files);
    } catch (const Error&) {
        return fmt::format("its {} cannot be read", file.filename().string());
    }
}

/// A part of the run made by one version of a plugin and a part made by another would be the
/// result of neither.
void require_same_strategies(const fs::path& folder, const RunFolder::Status& status,
                             const std::vector<UsedStrategy>& used) {
    const std::vector<UsedStrategy> changed = changed_strategies(used, status);
    if (changed.empty()) return;
    throw UsageError("run.resume", folder.string(),
                     fmt::format("contains the run of another version of a plugin: the content of "
                                 "{} has changed; nothing in it was changed",
                                 text_of(changed)),
                     remedy_of_resume);
}

/// The tables must contain at least what they contained at the checkpoint.
void require_tables(const fs::path& folder, const Checkpoint& checkpoint) {
    const auto require = [&folder](const char* name, std::uint64_t bytes) {
        std::error_code error;
        const std::uintmax_t size = fs::file_size(folder / name, error);
        if (error || size < bytes)
            throw IoError("checkpoint.unusable", folder.string(), "",
                          fmt::format("{} is shorter than at the checkpoint", name),
                          "start the run again without --resume");
    };
    require("metrics.csv", checkpoint.log.metrics_bytes);
    require("events.jsonl", checkpoint.log.events_bytes);
}

}  // namespace

std::string experiment_differences(const ConfigNode& there, const ConfigNode& here) {
    Comparison comparison;
    comparison.compare(&there, &here, "");
    return comparison.told();
}

std::optional<Checkpoint> checkpoint_to_resume(const fs::path& folder,
                                               const Checkpoints& checkpoints,
                                               const LoadedExperiment& loaded,
                                               const plugin::Catalogue& catalogue,
                                               const std::string& hash) {
    const std::optional<RunFolder::Status> status = RunFolder::status(folder);
    if (status && !status->hash.empty() && status->hash != hash) {
        throw UsageError(
            "run.resume", folder.string(),
            fmt::format("contains the run of another experiment: {}; nothing in it was changed",
                        difference_to(folder, loaded, catalogue)),
            remedy_of_resume);
    }
    if (status) require_same_strategies(folder, *status, used_strategies(loaded, catalogue));
    std::string reason;
    std::optional<Checkpoint> found = checkpoints.last(
        hash, [&folder](const Checkpoint& c) { require_tables(folder, c); }, &reason);
    if (!found && !reason.empty()) {
        throw UsageError(
            "run.resume", folder.string(),
            fmt::format(
                "has no checkpoint from which this run can continue: {}; nothing in it was changed",
                reason),
            remedy_of_resume);
    }
    return found;
}

}  // namespace dsc::run
