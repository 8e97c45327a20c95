#include "run_figures.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/run/run_folder.hpp>

namespace dsc::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The object in a file of the folder; null if there is none.
ordered_json object_in(const fs::path& file) {
    std::error_code error;
    if (!fs::exists(file, error)) return nullptr;
    ordered_json object = ordered_json::parse(read_file(file), nullptr, false);
    return object.is_object() ? object : ordered_json(nullptr);
}

/// The names in a folder, sorted.
std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (auto i = fs::directory_iterator(folder, error); !error && i != fs::directory_iterator();
         i.increment(error)) {
        names.push_back(i->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

ordered_json run_figures(const fs::path& folder) {
    if (!run::RunFolder::is_ours(folder)) {
        throw IoError("io.no_run", folder.string(), "", "is not a run folder",
                      "give a file or a run folder");
    }
    const ordered_json status = object_in(folder / "status.json");
    ordered_json figures;
    for (const char* name : {"state", "started", "finished", "exit_code", "error_code", "error"}) {
        const auto found = status.find(name);
        if (found != status.end() && !found->is_null() && *found != "") figures[name] = *found;
    }
    const std::string owner = run::RunFolder::owner(folder);
    if (!owner.empty()) figures["owner"] = owner;
    if (owner.empty() && figures.value("state", "") == "running") {
        figures["state"] = "killed";
        figures["remedy"] = "dsc run --resume continues from the last checkpoint";
    }
    if (const auto checkpoints = names_in(folder / "checkpoint"); !checkpoints.empty())
        figures["last_checkpoint"] = checkpoints.back();
    if (const auto files = names_in(folder / "result"); !files.empty()) figures["result"] = files;
    std::error_code error;
    if (fs::exists(folder / "report.html", error))
        figures["report"] = (folder / "report.html").string();
    if (const ordered_json summary = object_in(folder / "summary.json"); !summary.is_null())
        figures["summary"] = summary;
    return figures;
}

}  // namespace dsc::app
