// Collects the results of a sweep in one table.
#include <algorithm>
#include <array>
#include <fstream>
#include <map>

#include <nlohmann/json.hpp>

#include <dsc/base/error.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/sweep/sweep.hpp>

#include "table.hpp"

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

/// A row, before the columns of all rows are known.
struct Row {
    std::string status;  ///< done, failed, stopped, unfinished, missing
    std::string ended;   ///< how the schedule ended: converged, max_steps, ...
    std::string error;   ///< its error code
    std::map<std::string, std::string> figures;
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
Row read_row(const fs::path& folder) {
    const json status = read_point_json(folder / "status.json");
    Row row;
    if (!status.is_object()) {
        row.status = "missing";
        return row;
    }
    const std::string state = text_at(status, "state");
    row.status = state == "running" ? "unfinished" : state;
    row.error = text_at(status, "error_code");
    if (state != "done" && state != "stopped") return row;
    const json summary = read_point_json(folder / "summary.json");
    if (!summary.is_object()) {
        row.status = "unfinished";  // files are missing in the folder
        return row;
    }
    row.ended = text_at(summary, "status");
    add_figures(summary, "", row.figures);
    return row;
}

std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + "\"";
}

/// A string without quotes, everything else as in YAML.
std::string value_cell(const config::ConfigNode* value) {
    if (value == nullptr) return {};
    return cell(value->is_string() ? value->as_string() : config::flow_text(*value));
}

/// All paths that at least one point overrides, in the order in which they first appear.
std::vector<std::string> override_names(const std::vector<SweepJob>& jobs) {
    std::vector<std::string> names;
    for (const SweepJob& job : jobs) {
        for (const config::ConfigEntry& entry : job.overrides.entries()) {
            if (std::find(names.begin(), names.end(), entry.key) == names.end())
                names.push_back(entry.key);
        }
    }
    return names;
}

std::vector<std::string> column_names(const std::vector<Row>& rows) {
    std::vector<std::string> names(figure_names.begin(), figure_names.end());
    std::map<std::string, int> observed;
    for (const Row& row : rows) {
        for (const auto& figure : row.figures) {
            if (figure.first.rfind("observers.", 0) == 0) ++observed[figure.first];
        }
    }
    for (const auto& name : observed) names.push_back(name.first);
    names.insert(names.end(), cost_names.begin(), cost_names.end());
    return names;
}

void count(const Row& row, SweepStates& states) {
    ++states.points;
    if (row.status == "done") {
        ++states.done;
    } else if (row.status == "failed") {
        ++states.failed;
    } else if (row.status == "missing") {
        ++states.missing;
    } else {
        ++states.unfinished;
    }
}

}  // namespace

std::string collect_sweep(const fs::path& folder, SweepStates& states) {
    std::error_code ignored;
    if (!fs::exists(table_file(folder), ignored)) {
        throw UsageError("sweep.folder", folder.string(), "does not contain jobs.tsv",
                         "use a folder that dsc sweep expand wrote");
    }
    const std::vector<SweepJob> jobs = read_table(folder);
    std::vector<Row> rows;
    for (const SweepJob& job : jobs) {
        rows.push_back(read_row(folder / point_folder(job.name) / "run"));
        count(rows.back(), states);
    }
    const std::vector<std::string> overrides = override_names(jobs);
    const std::vector<std::string> columns = column_names(rows);

    std::string text = "index,folder,status,ended,error";
    for (const std::string& name : overrides) text += "," + cell(name);
    for (const std::string& name : columns) text += "," + cell(name);
    text += "\n";
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        text += std::to_string(i) + "," + point_folder(jobs[i].name) + "," + cell(rows[i].status) +
                "," + cell(rows[i].ended) + "," + cell(rows[i].error);
        for (const std::string& name : overrides)
            text += "," + value_cell(jobs[i].overrides.find(name));
        for (const std::string& name : columns) {
            const auto found = rows[i].figures.find(name);
            text += "," + (found == rows[i].figures.end() ? std::string() : found->second);
        }
        text += "\n";
    }
    return text;
}

}  // namespace dsc::sweep
