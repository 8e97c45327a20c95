// The sections of a report.
#include "sections.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <dsc/base/read_file.hpp>
#include <dsc/run/metrics.hpp>

#include "html.hpp"
#include "plot.hpp"
#include "warnings.hpp"

namespace dsc::report {
namespace {

using run::column_name;
using run::StepMetrics;

using html::integer;
using html::real;
using html::seconds;
using html::tag;
using html::text;
using nlohmann::ordered_json;

std::string how_it_ended(const RunRecord& record) {
    const std::string status = record.word("status");
    if (status == "max_steps") return "all steps done";
    if (status == "cancelled") return "stopped early";
    return status;
}

std::string card(const std::string& name, const std::string& value,
                 const std::string& classes = "") {
    return tag("div", tag("b", text(value)) + tag("span", text(name)), "card " + classes);
}

Curve curve(const RunRecord& record, std::string_view column, const std::string& name) {
    const std::vector<double>* x = record.metrics.find(column_name<&StepMetrics::step>);
    const std::vector<double>* y = record.metrics.find(column);
    if (x == nullptr || y == nullptr) return {};
    return {name, *x, *y};
}

/// Speeds in current mean edges, as in the stop criterion.
Curve in_edges(const RunRecord& record, std::string_view column, const std::string& name) {
    Curve out = curve(record, column, name);
    const std::vector<double>* edges = record.metrics.find(column_name<&StepMetrics::mean_edge>);
    for (std::size_t i = 0; edges != nullptr && i < out.y.size(); ++i) out.y[i] /= (*edges)[i];
    return out;
}

/// One plot per figure of an observer.
std::string observer_plots(const RunRecord& record) {
    std::string out;
    for (const std::string& column : record.metrics.columns) {
        if (column.rfind("observers.", 0) == 0)
            out += svg_plot({column.substr(10), "step", {curve(record, column, column)}});
    }
    return out;
}

/// One line per value; nested names are joined by blanks; lists are left out.
void flatten(const ordered_json& json, const std::string& prefix,
             std::vector<std::pair<std::string, std::string>>& rows) {
    for (const auto& [key, value] : json.items()) {
        const std::string name = prefix.empty() ? key : prefix + " " + key;
        if (value.is_object()) {
            flatten(value, name, rows);
        } else if (value.is_string()) {
            rows.emplace_back(name, value.get<std::string>());
        } else if (!value.is_array()) {
            rows.emplace_back(name, value.dump());
        }
    }
}

std::string word(const ordered_json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string command_line(const ordered_json& provenance) {
    const ordered_json* command = find(provenance, "command");
    std::string line;
    if (command == nullptr || !command->is_array()) return line;
    for (const ordered_json& item : *command) {
        std::string argument = item.is_string() ? item.get<std::string>() : item.dump();
        if (argument.empty() ||
            argument.find_first_of(" \t\n'\"$&;|<>()*?[]{}\\`") != std::string::npos) {
            std::string quoted = "'";
            for (const char c : argument)
                quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
            argument = quoted + "'";
        }
        line += (line.empty() ? "" : " ") + argument;
    }
    return line;
}

/// Rows of a list of objects in the provenance.
std::vector<html::Row> rows_of(const ordered_json& provenance, const char* list,
                               const std::vector<const char*>& keys) {
    std::vector<html::Row> rows;
    const ordered_json* items = find(provenance, list);
    if (items == nullptr || !items->is_array()) return rows;
    for (const ordered_json& item : *items) {
        if (!item.is_object()) continue;
        html::Row row;
        for (const char* key : keys) row.push_back(word(item, key));
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace

std::string section(const std::string& title, const std::string& body, const std::string& classes) {
    if (body.empty()) return "";
    return tag("section", tag("h2", text(title)) + "\n" + body, classes) + "\n";
}

std::vector<std::pair<std::string, std::string>> key_figures(const RunRecord& record) {
    const std::vector<Check> checks = validity(record);
    const bool valid =
        std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.holds; });
    std::vector<std::pair<std::string, std::string>> rows = {
        {"result", valid ? "valid" : "not valid"},
        {"end", how_it_ended(record)},
        {"steps", integer(record.number("steps"))},
        {"vertices of the surface", integer(record.number("interface_vertices"))},
        {"faces of the surface", integer(record.number("interface_faces"))},
        {"tets", integer(record.number("tets"))},
        {"least tet quality", real(record.number("min_tet_quality"))},
        {"components / genus",
         integer(record.number("components")) + " / " + integer(record.number("genus"))}};
    if (record.has("cloud_to_surface")) {
        rows.emplace_back("mean distance, cloud to surface",
                          real(record.number("cloud_to_surface.mean")));
        rows.emplace_back("mean distance, vertex to cloud",
                          real(record.number("vertex_to_cloud.mean")));
    }
    rows.emplace_back("volume", real(record.number("volume")));
    rows.emplace_back("wall time", seconds(record.number("wall_s")));
    rows.emplace_back("CPU time", seconds(record.number("cpu_s")));
    rows.emplace_back("peak memory", integer(record.number("peak_rss_mb")) + " MB");
    return rows;
}

std::string headline_section(const RunRecord& record) {
    std::string cards;
    for (const auto& [name, value] : key_figures(record)) {
        cards += card(name, value, name != "result" ? "" : value == "valid" ? "good" : "bad");
    }
    std::string list;
    for (const Check& check : validity(record)) {
        list += tag("li", text(check.name) + ": " + tag("b", text(check.value)),
                    check.holds ? "good" : "bad");
    }
    return section("In short", tag("div", cards, "cards") + "\n" +
                                   tag("p", "Measured on the files as written, read back:") + "\n" +
                                   tag("ul", list, "checks"));
}

std::string warnings_section(const RunRecord& record) {
    std::string list;
    for (const std::string& warning : warnings(record)) list += tag("li", text(warning)) + "\n";
    return list.empty() ? "" : section("Warnings", tag("ul", list), "warnings");
}

std::string notes_section(const RunRecord& record) {
    const nlohmann::ordered_json* filters = find(record.summary, "input.filters");
    if (filters == nullptr || !filters->is_array()) return "";
    std::string list;
    for (const nlohmann::ordered_json& filter : *filters) {
        const auto notes = filter.is_object() ? filter.find("notes") : filter.end();
        if (notes == filter.end() || !notes->is_array()) continue;
        for (const nlohmann::ordered_json& note : *notes)
            if (note.is_string()) list += tag("li", text(note.get<std::string>())) + "\n";
    }
    return list.empty() ? "" : section("Notes on the cloud", tag("ul", list), "notes");
}

std::string viewer(const RunRecord& record, const Scene& scene, const std::string& id) {
    if (scene.empty) return "";
    std::string picture;
    std::error_code error;
    if (std::filesystem::exists(record.folder / "preview.png", error)) {
        picture = "<img class=\"stand-in\" alt=\"the surface\" src=\"data:image/png;base64," +
                  html::base64(read_file(record.folder / "preview.png")) + "\">";
    }
    std::string notes;
    for (const std::string& note : scene.notes) notes += tag("li", text(note));
    return "<div class=\"viewer\" id=\"" + id + "\">" + picture +
           "</div>\n<script type=\"application/json\" id=\"" + id + "-scene\">" +
           html::json_in_script(scene.json) + "</script>\n" +
           (notes.empty() ? "" : tag("ul", notes, "notes") + "\n");
}

std::string viewer_section(const RunRecord& record, const Scene& scene) {
    const std::string body = viewer(record, scene, "view-0");
    if (body.empty()) return "";
    return section("The surface",
                   body + tag("p",
                              "Drag to rotate, use the wheel to zoom, drag with the right button "
                              "to move. Intermediate surfaces are drawn with fewer triangles.",
                              "hint"));
}

std::string plots_section(const RunRecord& record, const Scene& scene) {
    std::string convergence =
        svg_plot({.title = "Distance, normalised units",
                  .x_label = "step",
                  .curves = {curve(record, column_name<&StepMetrics::vertex_to_cloud_mean>,
                                   "vertex to cloud, mean"),
                             curve(record, column_name<&StepMetrics::vertex_to_cloud_max>,
                                   "vertex to cloud, largest"),
                             curve(record, column_name<&StepMetrics::cloud_to_surface_mean>,
                                   "cloud to surface, mean")},
                  .logarithmic = true}) +
        svg_plot({.title = "Speed, current mean edges per step",
                  .x_label = "step",
                  .curves = {in_edges(record, column_name<&StepMetrics::mean_speed>, "mean"),
                             in_edges(record, column_name<&StepMetrics::max_speed>, "largest")},
                  .logarithmic = true}) +
        svg_plot({.title = "Vertices of the surface",
                  .x_label = "step",
                  .curves = {curve(record, column_name<&StepMetrics::interface_vertices>, "")},
                  .from_zero = true}) +
        svg_plot({.title = "Volume, normalised units",
                  .x_label = "step",
                  .curves = {curve(record, column_name<&StepMetrics::volume>, "")},
                  .from_zero = true}) +
        observer_plots(record);
    std::string quality =
        svg_plot({.title = "Least tet quality",
                  .x_label = "step",
                  .curves = {curve(record, column_name<&StepMetrics::min_tet_quality>, "")},
                  .from_zero = true}) +
        svg_plot({.title = "Operations committed",
                  .x_label = "step",
                  .curves = {curve(record, column_name<&StepMetrics::committed>, "")},
                  .from_zero = true});
    if (!scene.qualities.empty())
        quality += svg_histogram("Tets by quality, result", "quality: 1 for a regular tet", 0.0,
                                 1.0, count_bins(scene.qualities, 0.0, 1.0, 40));
    if (!scene.distances.empty()) {
        const double most = *std::max_element(scene.distances.begin(), scene.distances.end());
        if (most > 0.0)
            quality += svg_histogram("Points of the cloud by distance",
                                     "distance to the surface, normalised units", 0.0, most,
                                     count_bins(scene.distances, 0.0, most, 40));
    }
    return section("Convergence", tag("div", convergence, "plots")) +
           section("Quality", tag("div", quality, "plots"));
}

std::vector<std::pair<std::string, double>> phases(const RunRecord& record) {
    std::vector<std::pair<std::string, double>> parts;
    double rest = record.number("wall_s");
    for (const char* phase : {"velocity", "move", "improve", "refine", "measure", "io"}) {
        double value = record.number(std::string("phase_wall_s.") + phase);
        // Older runs store wall time only.
        if (!std::isfinite(value)) value = record.number(std::string("phase_s.") + phase);
        if (!std::isfinite(value)) continue;
        parts.emplace_back(phase == std::string("io") ? "files" : phase, value);
        rest -= value;
    }
    if (rest > 0.0) parts.emplace_back("other", rest);
    return parts;
}

std::string time_section(const RunRecord& record) {
    return section("Time by phase", svg_shares(phases(record), "s"));
}

std::string topology_section(const RunRecord& record) {
    html::Row names, counts;
    const ordered_json* events = find(record.summary, "events");
    if (events == nullptr || !events->is_object()) return "";
    for (const auto& [kind, count] : events->items()) {
        std::string name = kind;
        std::replace(name.begin(), name.end(), '_', ' ');
        names.push_back(name);
        counts.push_back(count.is_number() ? integer(count.get<double>()) : "-");
    }
    std::string body = html::table(names, {counts});
    std::vector<html::Row> rows;
    const ordered_json* operations = find(record.summary, "operations");
    if (operations != nullptr && operations->is_object()) {
        for (const auto& [operation, figures] : operations->items()) {
            const ordered_json *tried = find(figures, "tried"),
                               *committed = find(figures, "committed");
            if (tried == nullptr || committed == nullptr || !tried->is_number() ||
                !committed->is_number())
                continue;
            if (!(tried->get<double>() > 0.0)) continue;
            std::string name = operation;
            std::replace(name.begin(), name.end(), '_', ' ');
            rows.push_back(
                {name, integer(tried->get<double>()), integer(committed->get<double>())});
        }
    }
    if (!rows.empty())
        body += tag("h3", "Local operations") + "\n" +
                html::table({"operation", "tried", "committed"}, rows);
    return section("Changes of topology", body);
}

std::string cloud_section(const RunRecord& record) {
    std::string body;
    for (const auto& [key, title] : {std::pair{"cloud", "The points, normalised units"},
                                     std::pair{"initial_mesh", "The initial mesh"}}) {
        const ordered_json* figures = find(record.summary, key);
        if (figures == nullptr || !figures->is_object() || figures->empty()) continue;
        std::vector<std::pair<std::string, std::string>> rows;
        for (const auto& [figure, value] : figures->items()) {
            std::string name = figure;
            std::replace(name.begin(), name.end(), '_', ' ');
            if (value.is_number())
                rows.emplace_back(name, value.is_number_integer() ? integer(value.get<double>())
                                                                  : real(value.get<double>()));
        }
        body += tag("h3", title) + "\n" + html::facts(rows);
    }
    return body.empty() ? "" : section("The cloud and the start", body);
}

std::string config_section(const RunRecord& record) {
    return section("Experiment, all defaults written out",
                   tag("pre", text(record.config), "config"));
}

std::string provenance_section(const RunRecord& record) {
    std::vector<std::pair<std::string, std::string>> rows = {
        {"command", command_line(record.provenance)}};
    flatten(record.provenance, "", rows);
    std::string body = html::facts(rows);
    const auto inputs = rows_of(record.provenance, "inputs", {"file", "sha256"});
    if (!inputs.empty())
        body += tag("h3", "Inputs") + "\n" + html::table({"file", "SHA-256"}, inputs, false);
    const auto plugins =
        rows_of(record.provenance, "plugins", {"name", "version", "license", "sha256"});
    if (!plugins.empty())
        body += tag("h3", "Plugins") + "\n" +
                html::table({"name", "version", "licence", "SHA-256"}, plugins, false);
    return section("Provenance", body, "provenance");
}

}  // namespace dsc::report
