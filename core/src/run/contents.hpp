#pragma once
// The contents on which a run depends besides its values: the plugins of its strategies, and the
// files that the experiment names.

#include <filesystem>
#include <string>
#include <vector>

#include <dsc/plugin/catalogue.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/run_folder.hpp>

namespace dsc::run {

/// A strategy that an experiment uses, and the content of the plugin or Python file that provides
/// it.
struct UsedStrategy {
    std::string kind;
    std::string id;
    std::filesystem::path file;
    std::string sha256;
    bool installed = false;  ///< comes with the program

    /// "velocity drift", the key in status.json.
    std::string key() const { return kind + " " + id; }
};

/// The strategies of the experiment, nested ones included, each once, in the order of the schema.
/// Throws IoError for a plugin that cannot be read. [setup]
std::vector<UsedStrategy> used_strategies(const LoadedExperiment& loaded,
                                          const plugin::Catalogue& catalogue);

/// Those whose content is not the one with which the folder was run. Nothing is known about a
/// folder of an older version. [setup]
std::vector<UsedStrategy> changed_strategies(const std::vector<UsedStrategy>& used,
                                             const RunFolder::Status& status);

/// "drift.so, which provides velocity 'drift'", joined by commas. [setup]
std::string text_of(const std::vector<UsedStrategy>& strategies);

/// The files and plugins that the experiment names and whose content is not that of the folder's
/// provenance.json, "cloud.xyz, pull.py"; empty if there are none or it cannot be read. [setup]
std::string changed_files(const std::filesystem::path& folder, const LoadedExperiment& loaded,
                          const plugin::Catalogue& catalogue);

}  // namespace dsc::run
