// The page that compares several runs.
#include <algorithm>
#include <map>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/report/report.hpp>
#include <dsc/run/metrics.hpp>
#include <dsc/text/words.hpp>

#include "compared.hpp"
#include "compared_tables.hpp"
#include "html.hpp"
#include "page.hpp"
#include "plot.hpp"
#include "sections.hpp"
#include "thesis.hpp"
#include "warnings.hpp"

namespace dsc::report {
namespace {

using run::column_name;
using run::StepMetrics;

namespace fs = std::filesystem;
using html::tag;
using html::text;

/// Longer tables are closed at first.
constexpr std::size_t open_rows = 24;

std::string folded(const std::string& title, const std::string& body, std::size_t rows) {
    if (body.empty()) return "";
    return std::string("<details") + (rows <= open_rows ? " open" : "") + ">" +
           tag("summary", text(title)) + body + "</details>\n";
}

/// What differs, one row per run.
std::string differences(const Comparison& comparison) {
    if (comparison.differ.empty()) return tag("p", "The experiments are the same.");
    html::Row header = {"run"};
    for (const std::string& path : comparison.differ) header.push_back(path);
    std::vector<html::Row> rows;
    for (const Compared& run : comparison.runs) {
        html::Row& row = rows.emplace_back(html::Row{run.name});
        for (const std::string& path : comparison.differ) row.push_back(run.value(path));
    }
    return folded("What differs: " + text::counted(comparison.differ.size(), "value"),
                  html::table(header, rows, false), rows.size());
}

/// What is the same in all experiments, listed once.
std::string common_values(const Comparison& comparison) {
    std::vector<std::pair<std::string, std::string>> rows;
    for (const std::string& path : comparison.paths) {
        const auto& differ = comparison.differ;
        if (std::find(differ.begin(), differ.end(), path) == differ.end())
            rows.emplace_back(path, comparison.runs.front().value(path));
    }
    if (rows.empty()) return "";
    return "<details>" +
           tag("summary", "The same in all experiments: " + text::counted(rows.size(), "value")) +
           html::facts(rows) + "</details>\n";
}

std::string plot(const Comparison& comparison, const std::string& title, std::string_view figure,
                 bool logarithmic) {
    const std::vector<std::size_t> shown = comparison.shown();
    Plot out{.title = title,
             .x_label = "step",
             .curves = {},
             .logarithmic = logarithmic,
             .from_zero = !logarithmic,
             .points = comparison.runs.size() > most_colours ? std::size_t{240} : Plot{}.points};
    for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
        const Compared& run = comparison.runs[i];
        const std::vector<double>* x = run.record.metrics.find(column_name<&StepMetrics::step>);
        const std::vector<double>* y = run.record.metrics.find(figure);
        if (x == nullptr || y == nullptr) continue;
        Curve curve{run.name, *x, *y, i, std::nullopt};
        const auto slot = std::find(shown.begin(), shown.end(), i);
        if (slot != shown.end()) curve.slot = static_cast<std::size_t>(slot - shown.begin());
        out.curves.push_back(std::move(curve));
    }
    return svg_plot(out);
}

/// The boxes with which a reader chooses the curves.
std::string chooser(const Comparison& comparison) {
    if (comparison.runs.size() < 2) return "";
    const std::vector<std::size_t> shown = comparison.shown();
    std::string boxes;
    for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
        const bool checked = std::find(shown.begin(), shown.end(), i) != shown.end();
        boxes += "<label><input type=\"checkbox\" value=\"" + std::to_string(i) + "\"" +
                 (checked ? " checked" : "") + "><i></i>" + text(comparison.runs[i].name) +
                 "</label>";
    }
    return "<fieldset class=\"chooser\" data-most=\"" + std::to_string(most_colours) + "\">" +
           tag("legend", "Runs in the plots, at most " + std::to_string(most_colours)) +
           tag("div", boxes) + "</fieldset>\n";
}

std::string plots(const Comparison& comparison) {
    const std::string all =
        plot(comparison, "Distance, cloud to surface, mean",
             column_name<&StepMetrics::cloud_to_surface_mean>, true) +
        plot(comparison, "Distance, vertex to cloud, mean",
             column_name<&StepMetrics::vertex_to_cloud_mean>, true) +
        plot(comparison, "Vertices of the surface", column_name<&StepMetrics::interface_vertices>,
             false) +
        plot(comparison, "Least tet quality", column_name<&StepMetrics::min_tet_quality>, false) +
        plot(comparison, "Mean speed, normalised units per step",
             column_name<&StepMetrics::mean_speed>, true) +
        plot(comparison, "Volume, normalised units", column_name<&StepMetrics::volume>, false);
    return all.empty() ? "" : chooser(comparison) + tag("div", all, "plots");
}

/// The preview of a run that has no view of its own on the page.
std::string picture(const RunRecord& record) {
    const fs::path file = record.folder / "preview.png";
    std::error_code error;
    if (!fs::exists(file, error)) return tag("p", "no picture", "hint");
    return "<img class=\"picture\" alt=\"the surface\" src=\"data:image/png;base64," +
           html::base64(read_file(file)) + "\">";
}

std::string viewers(const Comparison& comparison, const plugin::Catalogue& catalogue,
                    Workers* workers) {
    constexpr std::size_t most_pictures = 60;
    const std::vector<std::size_t> shown = comparison.shown();
    // All runs together may use as much memory as one run in its own report.
    SceneLimits limits;
    limits.frames = 0;
    limits.tets = 0;
    limits.faces = std::clamp<std::size_t>(100000 / shown.size(), 4000, 40000);
    limits.points = std::clamp<std::size_t>(60000 / shown.size(), 2000, 20000);
    std::string views, pictures;
    std::size_t view = 0, count = 0;
    for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
        const Compared& run = comparison.runs[i];
        const std::string title = tag("h3", text(run.name)) + "\n";
        if (std::find(shown.begin(), shown.end(), i) == shown.end()) {
            if (count++ < most_pictures)
                pictures += tag("div", title + picture(run.record), "run") + "\n";
            continue;
        }
        const Scene scene = make_scene(run.record, limits, {catalogue, nullptr}, workers);
        const std::string body = viewer(run.record, scene, "view-" + std::to_string(view++));
        views +=
            tag("div", title + (body.empty() ? tag("p", "nothing to show") : body), "run") + "\n";
    }
    std::string out = tag("div", views, "runs");
    if (count > 0) {
        const std::string all = tag("div", pictures, "runs small");
        out += "<details>" +
               tag("summary",
                   "Pictures of " + text::counted(std::min(count, most_pictures), "other run")) +
               all + "</details>\n";
    }
    return out;
}

std::string times(const Comparison& comparison) {
    std::vector<std::string> names;
    std::vector<std::map<std::string, double>> values;
    for (const Compared& run : comparison.runs) {
        auto& of_run = values.emplace_back();
        for (const auto& [phase, seconds] : phases(run.record)) {
            if (std::find(names.begin(), names.end(), phase) == names.end()) names.push_back(phase);
            of_run[phase] = seconds;
        }
    }
    html::Row header = {"run"};
    for (const std::string& name : names) header.push_back(name);
    std::vector<html::Row> rows;
    for (std::size_t i = 0; i < values.size(); ++i) {
        html::Row& row = rows.emplace_back(html::Row{comparison.runs[i].name});
        for (const std::string& name : names)
            row.push_back(values[i].count(name) != 0 ? html::real(values[i].at(name)) + " s" : "-");
    }
    return folded("Wall seconds per phase", html::table(header, rows), rows.size());
}

std::string thesis_tables(const Comparison& comparison) {
    std::vector<NamedRecord> runs;
    for (const Compared& run : comparison.runs) runs.push_back({&run.record, run.name});
    return folded("Tables 6.1 and 6.2 for all runs", thesis_comparison(runs), runs.size());
}

/// Each warning once, with the runs that have it.
std::string all_warnings(const Comparison& comparison) {
    std::vector<std::pair<std::string, std::vector<std::string>>> found;
    for (const Compared& run : comparison.runs) {
        for (const std::string& warning : warnings(run.record)) {
            auto known = std::find_if(found.begin(), found.end(),
                                      [&](const auto& entry) { return entry.first == warning; });
            if (known == found.end()) known = found.insert(found.end(), {warning, {}});
            known->second.push_back(run.name);
        }
    }
    std::string list;
    for (const auto& [warning, runs] : found) {
        std::string names;
        for (std::size_t i = 0; i < std::min<std::size_t>(3, runs.size()); ++i)
            names += (i == 0 ? "" : "; ") + runs[i];
        if (runs.size() > 3) names += " and " + text::counted(runs.size() - 3, "other run");
        list +=
            tag("li", text(warning) + " " + tag("span", "(" + text(names) + ")", "hint")) + "\n";
    }
    const std::string title = text::counted(found.size(), "warning") + ", each once";
    return list.empty()
               ? ""
               : section("Warnings", folded(title, tag("ul", list), found.size()), "warnings");
}

}  // namespace

std::string comparison_html(std::span<const ComparedRun> runs, const plugin::Catalogue& catalogue,
                            Workers* workers) {
    if (runs.empty())
        throw UsageError("report.no_run", "comparison", "it needs at least one run",
                         "name the folders of the runs");
    return guarded_report([&] {
        const Comparison comparison = compare_runs(runs);
        const std::string body =
            section("In short",
                    groups_table(comparison) + runs_table(comparison) + same_figures(comparison)) +
            section("Two settings in pairs", pairs_table(comparison)) + all_warnings(comparison) +
            section("The surfaces", viewers(comparison, catalogue, workers)) +
            section("Convergence", plots(comparison)) +
            section("The thesis' tables", thesis_tables(comparison)) +
            section("Time by phase", times(comparison)) +
            section("The experiments", differences(comparison) + common_values(comparison)) +
            comparison_data(comparison);
        std::string title = text::counted(comparison.runs.size(), "run") + " compared";
        if (comparison.repeated())
            title = text::counted(comparison.groups.size(), "group") + " of " + title;
        return report_page(
            PageKind::comparison, title,
            comparison.sweep ? "in the order of the sweep" : "in the order of the command line",
            body);
    });
}

}  // namespace dsc::report
