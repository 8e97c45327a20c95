// The page that compares several runs.
#include <algorithm>
#include <functional>
#include <map>

#include <dsc/base/error.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/report/report.hpp>
#include <dsc/run/metrics.hpp>
#include <dsc/text/words.hpp>

#include "html.hpp"
#include "page.hpp"
#include "plot.hpp"
#include "sections.hpp"
#include "warnings.hpp"

namespace dsc::report {
namespace {

using run::column_name;
using run::StepMetrics;

namespace fs = std::filesystem;
using html::tag;
using html::text;

/// A run and its name on the page.
struct Column {
    RunRecord record;
    std::string name;
};

/// Runs of one experiment have the same name; then the folder distinguishes them.
std::vector<Column> read_columns(std::span<const fs::path> folders) {
    std::vector<Column> columns;
    std::map<std::string, int> seen;
    for (const fs::path& folder : folders) {
        columns.push_back({read_record(folder), ""});
        ++seen[columns.back().record.name()];
    }
    for (Column& column : columns) {
        column.name = column.record.name();
        if (seen[column.name] < 2) continue;
        const fs::path folder = column.record.folder.lexically_normal();
        column.name =
            (folder.has_filename() ? folder.filename() : folder.parent_path().filename()).string();
    }
    return columns;
}

html::Row column_header(const std::vector<Column>& columns, const std::string& first) {
    html::Row row = {first};
    for (const Column& column : columns) row.push_back(column.name);
    return row;
}

/// Every entry that at least one of the runs has, one column per run.
std::string comparison(
    const std::vector<Column>& columns, const std::string& heading,
    const std::function<std::vector<std::pair<std::string, std::string>>(const RunRecord&)>&
        entries) {
    std::vector<std::string> names;
    std::vector<std::map<std::string, std::string>> values;
    for (const Column& column : columns) {
        auto& of_run = values.emplace_back();
        for (const auto& [name, value] : entries(column.record)) {
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
            of_run[name] = value;
        }
    }
    std::vector<html::Row> rows;
    for (const std::string& name : names) {
        html::Row& row = rows.emplace_back(html::Row{name});
        for (const auto& of_run : values)
            row.push_back(of_run.count(name) != 0 ? of_run.at(name) : "-");
    }
    return html::table(column_header(columns, heading), rows);
}

std::vector<std::pair<std::string, std::string>> times(const RunRecord& record) {
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& [phase, seconds] : phases(record))
        out.emplace_back(phase, html::real(seconds) + " s");
    return out;
}

/// The scalar values of a configuration by their dotted paths.
void collect(const config::ConfigNode& node, std::vector<std::string>& order,
             std::map<std::string, std::string>& out) {
    if ((node.is_map() || node.is_list()) && node.size() > 0) {
        if (node.is_map()) {
            for (const config::ConfigEntry& entry : node.entries())
                collect(entry.value, order, out);
        } else {
            for (const config::ConfigNode& item : node.items()) collect(item, order, out);
        }
        return;
    }
    const std::string path = node.path();
    std::string value;
    if (node.is_null()) {
        value = "none";
    } else if (node.is_boolean()) {
        value = node.as_boolean() ? "true" : "false";
    } else if (node.is_integer()) {
        value = std::to_string(node.as_integer());
    } else if (node.is_real()) {
        value = config::real_text(node.as_real());
    } else if (node.is_string()) {
        value = node.as_string();
    } else {
        value = "empty";
    }
    if (std::find(order.begin(), order.end(), path) == order.end()) order.push_back(path);
    out[path] = value;
}

std::string differences(const std::vector<Column>& columns) {
    std::vector<std::string> order;
    std::vector<std::map<std::string, std::string>> values;
    for (const Column& column : columns)
        collect(column.record.resolved, order, values.emplace_back());
    std::vector<html::Row> rows;
    for (const std::string& path : order) {
        html::Row row = {path};
        for (auto& of_run : values) row.push_back(of_run.count(path) != 0 ? of_run[path] : "-");
        const bool same = std::all_of(row.begin() + 2, row.end(),
                                      [&](const std::string& value) { return value == row[1]; });
        if (!same) rows.push_back(std::move(row));
    }
    if (rows.empty()) return tag("p", "The experiments are the same.");
    return html::table(column_header(columns, "key"), rows, false);
}

std::string plot(const std::vector<Column>& columns, const std::string& title,
                 std::string_view figure, bool logarithmic) {
    Plot out{.title = title,
             .x_label = "step",
             .curves = {},
             .logarithmic = logarithmic,
             .from_zero = !logarithmic};
    for (const Column& column : columns) {
        const std::vector<double>* x = column.record.metrics.find(column_name<&StepMetrics::step>);
        const std::vector<double>* y = column.record.metrics.find(figure);
        if (x != nullptr && y != nullptr) out.curves.push_back({column.name, *x, *y});
    }
    return svg_plot(out);
}

std::string viewers(const std::vector<Column>& columns, const plugin::Catalogue& catalogue,
                    Workers* workers) {
    // All runs together may use as much memory as one run in its own report.
    SceneLimits limits;
    limits.frames = 0;
    limits.tets = 0;
    limits.faces = std::clamp<std::size_t>(100000 / columns.size(), 4000, 40000);
    limits.points = std::clamp<std::size_t>(60000 / columns.size(), 2000, 20000);
    std::string out;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const Scene scene = make_scene(columns[i].record, limits, {catalogue, nullptr}, workers);
        const std::string body = viewer(columns[i].record, scene, "view-" + std::to_string(i));
        out += tag("div",
                   tag("h3", text(columns[i].name)) + "\n" +
                       (body.empty() ? tag("p", "nothing to show") : body),
                   "run") +
               "\n";
    }
    return tag("div", out, "runs");
}

std::string all_warnings(const std::vector<Column>& columns) {
    std::string list;
    for (const Column& column : columns) {
        for (const std::string& warning : warnings(column.record))
            list += tag("li", tag("b", text(column.name)) + ": " + text(warning)) + "\n";
    }
    return list.empty() ? "" : section("Warnings", tag("ul", list), "warnings");
}

}  // namespace

std::string comparison_html(std::span<const fs::path> run_folders,
                            const plugin::Catalogue& catalogue, Workers* workers) {
    if (run_folders.empty())
        throw UsageError("report.no_run", "comparison", "it needs at least one run",
                         "name the folders of the runs");
    return guarded_report([&] {
        const std::vector<Column> columns = read_columns(run_folders);
        const std::string plots =
            plot(columns, "Distance, cloud to surface, mean",
                 column_name<&StepMetrics::cloud_to_surface_mean>, true) +
            plot(columns, "Distance, vertex to cloud, mean",
                 column_name<&StepMetrics::vertex_to_cloud_mean>, true) +
            plot(columns, "Vertices of the surface", column_name<&StepMetrics::interface_vertices>,
                 false) +
            plot(columns, "Least tet quality", column_name<&StepMetrics::min_tet_quality>, false) +
            plot(columns, "Mean speed, normalised units per step",
                 column_name<&StepMetrics::mean_speed>, true) +
            plot(columns, "Volume, normalised units", column_name<&StepMetrics::volume>, false);
        const std::string body = section("In short", comparison(columns, "figure", key_figures)) +
                                 all_warnings(columns) +
                                 section("The surfaces", viewers(columns, catalogue, workers)) +
                                 section("Convergence", tag("div", plots, "plots")) +
                                 section("Time by phase", comparison(columns, "phase", times)) +
                                 section("What differs in the experiments", differences(columns));
        return report_page(text::counted(columns.size(), "run") + " compared", "one column per run",
                           body);
    });
}

}  // namespace dsc::report
