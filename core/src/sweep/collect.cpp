// Reads the results of the points of a sweep.
#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/surface/truth_figures.hpp>
#include <dsc/sweep/results.hpp>
#include <dsc/text/numbers.hpp>

#include "table.hpp"
#include "truth.hpp"

namespace dsc::sweep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Names in summary.json, in the order of the columns; the columns of the observers come before the
/// costs.
constexpr std::array figure_names = {"steps",
                                     "interface_vertices",
                                     "interface_faces",
                                     "tets",
                                     "min_tet_quality",
                                     "inverted_tets",
                                     "components",
                                     "genus",
                                     "volume",
                                     "volume_initial",
                                     "boundary_edges",
                                     "nonmanifold_edges",
                                     "nonmanifold_vertices",
                                     "self_intersections",
                                     "vertex_to_cloud.mean",
                                     "vertex_to_cloud.max",
                                     "cloud_to_surface.mean",
                                     "cloud_to_surface.max"};
constexpr std::array cost_names = {"wall_s", "cpu_s", "peak_rss_mb"};
const std::string truth_prefix = "truth.";

/// The versions of the strategies of the finished points: results of different versions must not be
/// compared unnoticed.
class Versions {
public:
    /// `status` is that of the point.
    void add(const std::string& point, const json& status) {
        const auto found = status.find("strategies");
        if (found == status.end() || !found->is_object()) return;
        for (const auto& item : found->items()) {
            if (!item.value().is_string()) continue;
            const Version here{item.value().get<std::string>(), point};
            const auto [first, fresh] = first_.try_emplace(item.key(), here);
            if (!fresh && first->second.sha256 != here.sha256)
                changed_.try_emplace(item.key(), here);
        }
    }

    void warn() const {
        for (const auto& [strategy, other] : changed_) {
            const Version& first = first_.at(strategy);
            log(LogLevel::warning, "the points were run with different versions of " + strategy +
                                       ": its plugin or Python file was not the same for " +
                                       point_folder(first.point) + " and " +
                                       point_folder(other.point) +
                                       "; to compare them, expand the sweep into a new folder and "
                                       "run it with one version");
        }
    }

private:
    struct Version {
        std::string sha256;
        std::string point;
    };
    std::map<std::string, Version> first_;    ///< by strategy, "KIND ID"
    std::map<std::string, Version> changed_;  ///< the first point that differs
};

json read_point_json(const fs::path& file) {
    std::ifstream stream(file);
    return stream ? json::parse(stream, nullptr, false) : json();
}

std::string text_at(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Adds numbers and booleans under dotted names.
void add_figures(const json& value, const std::string& name,
                 std::map<std::string, std::string>& figures) {
    if (value.is_object()) {
        for (const auto& item : value.items())
            add_figures(item.value(), name.empty() ? item.key() : name + "." + item.key(), figures);
    } else if (value.is_number() || value.is_boolean()) {
        figures[name] = value.dump();
    }
}

/// status.json of a killed run also says "running": such a run is unfinished, whether or not it is
/// still active.
void read_run(const fs::path& folder, PointResult& row, Versions& versions) {
    const json status = read_point_json(folder / "status.json");
    if (!status.is_object()) {
        row.status = "missing";
        return;
    }
    const std::string state = text_at(status, "state");
    row.status = state == "running" ? "unfinished" : state;
    row.error = text_at(status, "error_code");
    if (state != "done" && state != "stopped") return;
    const json summary = read_point_json(folder / "summary.json");
    if (!summary.is_object()) {
        row.status = "unfinished";  // files are missing in the folder
        return;
    }
    versions.add(row.name, status);
    row.ended = text_at(summary, "status");
    add_figures(summary, "", row.figures);
}

/// All paths that at least one point overrides, in the order in which they first appear.
std::vector<std::string> override_names(const std::vector<PointResult>& points) {
    std::vector<std::string> names;
    for (const PointResult& point : points) {
        for (const config::ConfigEntry& entry : point.overrides.entries()) {
            if (std::find(names.begin(), names.end(), entry.key) == names.end())
                names.push_back(entry.key);
        }
    }
    return names;
}

std::vector<std::string> figure_columns(const std::vector<PointResult>& points) {
    std::vector<std::string> names(figure_names.begin(), figure_names.end());
    std::set<std::string> observed;
    bool truth = false;
    for (const PointResult& point : points) {
        for (const auto& figure : point.figures) {
            if (figure.first.rfind("observers.", 0) == 0) observed.insert(figure.first);
            truth = truth || figure.first.rfind(truth_prefix, 0) == 0;
        }
    }
    names.insert(names.end(), observed.begin(), observed.end());
    if (truth) {
        for (const auto& figure : surface::truth_figures({}))
            names.push_back(truth_prefix + figure.first);
    }
    names.insert(names.end(), cost_names.begin(), cost_names.end());
    return names;
}

void count(const PointResult& point, SweepStates& states) {
    ++states.points;
    if (point.status == "done") {
        ++states.done;
    } else if (point.status == "failed") {
        ++states.failed;
    } else if (point.status == "missing") {
        ++states.missing;
    } else {
        ++states.unfinished;
    }
}

}  // namespace

SweepResults collect_sweep(const fs::path& folder, Workers* workers) {
    std::error_code ignored;
    if (!fs::exists(table_file(folder), ignored)) {
        throw UsageError("sweep.folder", folder.string(), "does not contain jobs.tsv",
                         "use a folder that dsc sweep expand wrote");
    }
    SweepResults results;
    Truths truths(workers);
    Versions versions;
    for (SweepJob& job : read_table(folder)) {
        PointResult& point = results.points.emplace_back();
        point.name = std::move(job.name);
        point.overrides = std::move(job.overrides);
        const fs::path place = folder / point_folder(point.name);
        read_run(place / "run", point, versions);
        count(point, results.states);
        if (point.figures.empty()) continue;
        for (const auto& [name, value] : truths.figures(place))
            point.figures[truth_prefix + name] = text::exact(value);
    }
    versions.warn();
    results.overrides = override_names(results.points);
    results.figures = figure_columns(results.points);
    return results;
}

std::vector<std::optional<PointOfRun>> points_of_runs(std::span<const fs::path> run_folders,
                                                      Workers* workers) {
    std::vector<std::optional<PointOfRun>> points;
    std::map<fs::path, std::vector<SweepJob>> tables;
    Truths truths(workers);
    bool readable = true;
    for (const fs::path& run : run_folders) {
        std::optional<PointOfRun>& found = points.emplace_back();
        std::error_code error;
        const fs::path place = fs::weakly_canonical(run / "status.json", error).parent_path();
        const fs::path point = place.parent_path(), folder = point.parent_path().parent_path();
        if (error || !fs::exists(table_file(folder), error)) continue;
        const auto [table, fresh] = tables.try_emplace(folder);
        if (fresh) table->second = read_table(folder);
        const std::vector<SweepJob>& jobs = table->second;
        const auto job = std::find_if(jobs.begin(), jobs.end(), [&](const SweepJob& known) {
            return folder / point_folder(known.name) / "run" == place;
        });
        if (job == jobs.end()) continue;
        found = PointOfRun{static_cast<std::size_t>(job - jobs.begin()), job->overrides, {}};
        try {
            if (readable) found->truth = truths.figures(point);
        } catch (const IoError& fault) {
            log(LogLevel::warning,
                std::string("without the figures of the truth: ") + fault.what());
            readable = false;
        }
    }
    return points;
}

}  // namespace dsc::sweep
