// Builds the tables of a comparison.
#include "compared_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <nlohmann/json.hpp>

#include <dsc/statistics/paired.hpp>
#include <dsc/text/numbers.hpp>
#include <dsc/text/words.hpp>

#include "html.hpp"
#include "warnings.hpp"

namespace dsc::report {
namespace {

using html::real;
using html::tag;
using html::text;
using nlohmann::ordered_json;

/// A figure of the tables.
struct Figure {
    std::string title;
    std::string path;  ///< of Compared::figure
    bool whole = false;

    std::string show(double value) const { return whole ? html::integer(value) : real(value); }
};

/// Columns that fit beside each other on a page.
constexpr std::size_t most_keys = 5;
constexpr std::size_t most_columns = 12;
/// More settings than this are compared only with the first one.
constexpr std::size_t most_settings = 30;

std::vector<Figure> all_figures(const Comparison& comparison) {
    std::vector<Figure> figures = {{"steps", "steps", true},
                                   {"vertices", "interface_vertices", true},
                                   {"tets", "tets", true},
                                   {"least tet quality", "min_tet_quality"},
                                   {"components", "components", true},
                                   {"genus", "genus", true},
                                   {"Chamfer distance, %", "truth.chamfer_percent"},
                                   {"Hausdorff distance, %", "truth.hausdorff_percent"},
                                   {"normal consistency", "truth.normal_consistency"},
                                   {"F-score at 1 %", "truth.f_score_1_percent"},
                                   {"mean distance, cloud to surface", "cloud_to_surface.mean"},
                                   {"CPU time, s", "cpu_s"},
                                   {"mean distance, vertex to cloud", "vertex_to_cloud.mean"},
                                   {"volume", "volume"}};
    std::set<std::string> observed;
    for (const Compared& run : comparison.runs) {
        const ordered_json* observers = find(run.record.summary, "observers");
        if (observers == nullptr || !observers->is_object()) continue;
        for (const auto& [id, found] : observers->items()) {
            if (!found.is_object()) continue;
            for (const auto& [name, value] : found.items()) {
                if (value.is_number()) observed.insert(id + "." + name);
            }
        }
    }
    for (const std::string& name : observed) figures.push_back({name, "observers." + name});
    figures.push_back({"wall time, s", "wall_s"});
    figures.push_back({"peak memory, MB", "peak_rss_mb", true});
    return figures;
}

bool equal(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool same_for_all(const Comparison& comparison, const Figure& figure) {
    const double first = comparison.runs.front().figure(figure.path);
    return std::all_of(comparison.runs.begin(), comparison.runs.end(),
                       [&](const Compared& run) { return equal(run.figure(figure.path), first); });
}

/// The figures of the columns: those that differ, as many as fit.
std::vector<Figure> column_figures(const Comparison& comparison) {
    std::vector<Figure> figures;
    for (Figure& figure : all_figures(comparison)) {
        if (figures.size() + std::min(comparison.keys.size(), most_keys) == most_columns) break;
        if (comparison.runs.size() == 1 || !same_for_all(comparison, figure))
            figures.push_back(std::move(figure));
    }
    return figures;
}

/// A cell as markup, with the value by which its column is sorted.
std::string data_cell(const std::string& markup, const std::string& key) {
    return "<td data-key=\"" + text(key) + "\">" + markup + "</td>";
}

std::string key_of(double value) { return std::isfinite(value) ? dsc::text::exact(value) : ""; }

/// The same for what differs: short values stay on one line.
std::string key_cell(const std::string& value, const std::string& key) {
    return "<td class=\"key\" title=\"" + text(value) + "\" data-key=\"" + text(key) + "\">" +
           text(value) + "</td>";
}

/// A header that sorts its column.
std::string head_cell(const std::string& title, const std::string& full) {
    return "<th scope=\"col\" title=\"" + text(full) + "\"><button type=\"button\">" + text(title) +
           "</button></th>";
}

std::string sortable(const std::string& id, const std::string& caption, const std::string& head,
                     const std::string& rows) {
    return "<div class=\"wide\"><table class=\"sortable\" id=\"" + id + "\"><caption>" +
           text(caption) + "</caption>" + tag("thead", tag("tr", head)) + "\n" +
           tag("tbody", rows) +
           "</table></div>\n<p class=\"bar\"><button type=\"button\" "
           "class=\"export\" data-table=\"" +
           id + "\">Save as CSV</button></p>\n";
}

/// The columns of what differs: of a sweep the overrides, otherwise the names of the runs and what
/// differs in their experiments.
std::vector<std::string> shown_keys(const Comparison& comparison, bool seed) {
    std::vector<std::string> keys;
    for (const std::string& key : comparison.keys) {
        if (keys.size() < most_keys && (seed || key != "seed") &&
            (comparison.sweep || key.rfind("output.", 0) != 0))
            keys.push_back(key);
    }
    return keys;
}

std::string key_heads(const Comparison& comparison, bool seed) {
    std::string head = comparison.sweep ? head_cell("#", "index in the sweep")
                                        : head_cell("run", "folder of the run");
    for (const std::string& key : shown_keys(comparison, seed))
        head += head_cell(comparison.short_key(key), key);
    return head;
}

std::string key_cells(const Comparison& comparison, const Compared& run, const std::string& name,
                      bool seed) {
    std::string cells = key_cell(name, comparison.sweep ? std::to_string(run.index) : name);
    for (const std::string& key : shown_keys(comparison, seed))
        cells += key_cell(run.value(key), run.value(key));
    return cells;
}

std::string result_of(const Compared& run) {
    const std::vector<Check> checks = validity(run.record);
    const bool valid =
        std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.holds; });
    const std::string status = run.record.word("status");
    const std::string end = status == "max_steps" ? "all steps" : status;
    return (valid ? "valid, " : "not valid, ") + end;
}

bool same_results(const Comparison& comparison) {
    return std::all_of(comparison.runs.begin(), comparison.runs.end(), [&](const Compared& run) {
        return result_of(run) == result_of(comparison.runs.front());
    });
}

statistics::Sample sample_of(const Comparison& comparison, const statistics::Group& group,
                             const std::string& path) {
    std::vector<double> values;
    for (const std::size_t i : group.runs) values.push_back(comparison.runs[i].figure(path));
    return statistics::summarise(values);
}

std::string sample_cell(const statistics::Sample& sample) {
    if (sample.n == 0) return data_cell("-", "");
    std::string markup = tag("b", real(sample.mean));
    if (std::isfinite(sample.deviation)) {
        markup += tag("span", "&plusmn; " + real(sample.deviation)) +
                  tag("span", real(sample.low) + " to " + real(sample.high));
    }
    return data_cell(markup, key_of(sample.mean));
}

std::vector<std::string> paired_row(const Figure& figure, const statistics::PairedComparison& c) {
    const auto number = [](double value) { return real(value); };
    return {figure.title,
            std::to_string(c.difference.n),
            number(c.first.mean),
            number(c.second.mean),
            number(c.difference.mean),
            number(c.difference.low) + " to " + number(c.difference.high),
            number(c.ranks.probability),
            std::to_string(c.signs.positive) + " / " + std::to_string(c.signs.negative) + " / " +
                std::to_string(c.signs.zero),
            number(c.signs.probability)};
}

/// The rows of a comparison of two settings; empty without pairs.
ordered_json paired_rows(const Comparison& comparison, std::size_t a, std::size_t b) {
    const auto setting = [&](std::size_t wanted) {
        const auto group =
            std::find_if(comparison.groups.begin(), comparison.groups.end(),
                         [&](const statistics::Group& found) { return found.setting == wanted; });
        return comparison.identities[group->runs.front()].setting;
    };
    const auto pairs = statistics::pair_runs(comparison.identities, setting(a), setting(b));
    ordered_json rows = ordered_json::array();
    if (pairs.empty()) return rows;
    for (const Figure& figure : column_figures(comparison)) {
        std::vector<double> first, second;
        for (const auto& [i, j] : pairs) {
            first.push_back(comparison.runs[i].figure(figure.path));
            second.push_back(comparison.runs[j].figure(figure.path));
        }
        const auto found = statistics::compare_pairs(first, second);
        if (found.difference.n > 0) rows.push_back(paired_row(figure, found));
    }
    return rows;
}

/// "0,1" to the rows, for all pairs of settings, or for all with the first.
ordered_json all_pairs(const Comparison& comparison) {
    ordered_json all = ordered_json::object();
    const std::size_t count = comparison.settings();
    for (std::size_t a = 0; a < (count > most_settings ? 1 : count); ++a) {
        for (std::size_t b = a + 1; b < count; ++b) {
            ordered_json rows = paired_rows(comparison, a, b);
            if (!rows.empty()) all[std::to_string(a) + "," + std::to_string(b)] = std::move(rows);
        }
    }
    return all;
}

/// All numbers of a summary by their dotted paths.
void collect_numbers(const ordered_json& json, const std::string& path,
                     std::vector<std::string>& order) {
    for (const auto& [key, value] : json.items()) {
        const std::string name = path.empty() ? key : path + "." + key;
        if (value.is_object()) {
            collect_numbers(value, name, order);
        } else if (value.is_number() &&
                   std::find(order.begin(), order.end(), name) == order.end()) {
            order.push_back(name);
        }
    }
}

ordered_json number_json(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json();
}

/// Every number of every run.
ordered_json runs_data(const Comparison& comparison) {
    std::vector<std::string> paths;
    for (const auto& [name, value] : comparison.runs.front().truth)
        paths.push_back("truth." + name);
    for (const Compared& run : comparison.runs) collect_numbers(run.record.summary, "", paths);
    ordered_json header = {"index", "run", "status"};
    for (const std::string& key : comparison.keys) header.push_back(key);
    for (const std::string& path : paths) header.push_back(path);
    ordered_json rows = ordered_json::array();
    rows.push_back(header);
    for (const Compared& run : comparison.runs) {
        ordered_json row = {run.index, run.name, run.record.word("status")};
        for (const std::string& key : comparison.keys) row.push_back(run.value(key));
        for (const std::string& path : paths) row.push_back(number_json(run.figure(path)));
        rows.push_back(std::move(row));
    }
    return rows;
}

ordered_json groups_data(const Comparison& comparison) {
    const std::vector<Figure> figures = column_figures(comparison);
    ordered_json header = {"group", "setting", "runs", "n"};
    for (const Figure& figure : figures) {
        for (const char* part : {".mean", ".deviation", ".low", ".high"})
            header.push_back(figure.path + part);
    }
    ordered_json rows = ordered_json::array();
    rows.push_back(header);
    for (std::size_t g = 0; g < comparison.groups.size(); ++g) {
        const statistics::Group& group = comparison.groups[g];
        ordered_json row = {g, group.setting, comparison.group_name(group), group.runs.size()};
        for (const Figure& figure : figures) {
            const statistics::Sample s = sample_of(comparison, group, figure.path);
            for (const double value : {s.mean, s.deviation, s.low, s.high})
                row.push_back(number_json(value));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string choice(const std::string& name, const Comparison& comparison, std::size_t chosen) {
    std::string options;
    for (std::size_t i = 0; i < comparison.settings(); ++i) {
        options += "<option value=\"" + std::to_string(i) + "\"" +
                   (i == chosen ? " selected" : "") + ">" + std::to_string(i) + ": " +
                   text(comparison.setting_name(i)) + "</option>";
    }
    return "<label>" + name + " <select class=\"" + name + "\">" + options + "</select></label> ";
}

}  // namespace

std::string groups_table(const Comparison& comparison) {
    if (!comparison.repeated()) return "";
    const std::vector<Figure> figures = column_figures(comparison);
    std::string head = key_heads(comparison, false) + head_cell("n", "number of runs");
    for (const Figure& figure : figures) head += head_cell(figure.title, figure.path);
    std::string rows;
    for (const statistics::Group& group : comparison.groups) {
        const Compared& first = comparison.runs[group.runs.front()];
        const std::string name =
            comparison.sweep ? std::to_string(first.index) : comparison.group_name(group);
        std::string row =
            key_cells(comparison, first, name, false) +
            data_cell(std::to_string(group.runs.size()), std::to_string(group.runs.size()));
        for (const Figure& figure : figures)
            row += sample_cell(sample_of(comparison, group, figure.path));
        rows += tag("tr", row) + "\n";
    }
    return sortable("groups",
                    "Repeats: mean, ± standard deviation (n - 1), and the 95 % confidence "
                    "interval of the mean (Student's t)",
                    head, rows);
}

std::string runs_table(const Comparison& comparison) {
    const std::vector<Figure> figures = column_figures(comparison);
    const bool results = !same_results(comparison);
    std::string head = key_heads(comparison, true);
    if (results) head += head_cell("result", "whether the files are valid, and how the run ended");
    for (const Figure& figure : figures) head += head_cell(figure.title, figure.path);
    std::string rows;
    for (const Compared& run : comparison.runs) {
        const std::string name = comparison.sweep ? std::to_string(run.index) : run.name;
        std::string row = key_cells(comparison, run, name, true);
        if (results) row += data_cell(text(result_of(run)), result_of(run));
        for (const Figure& figure : figures) {
            const double value = run.figure(figure.path);
            row += data_cell(figure.show(value), key_of(value));
        }
        rows += tag("tr", row) + "\n";
    }
    return sortable("runs", "Every run", head, rows);
}

std::string same_figures(const Comparison& comparison) {
    if (comparison.runs.size() < 2) return "";
    std::string list;
    if (same_results(comparison)) list = "result " + result_of(comparison.runs.front());
    for (const Figure& figure : all_figures(comparison)) {
        const double value = comparison.runs.front().figure(figure.path);
        if (std::isnan(value) || !same_for_all(comparison, figure)) continue;
        list += (list.empty() ? "" : "; ") + figure.title + " " + figure.show(value);
    }
    return list.empty() ? ""
                        : tag("p", "The same for all runs: " + text(list) + ".", "hint") + "\n";
}

std::string pairs_table(const Comparison& comparison) {
    const ordered_json pairs = all_pairs(comparison);
    if (pairs.empty()) return "";
    std::string head;
    for (const char* title : {"figure", "pairs", "first", "second", "difference", "95 % interval",
                              "p, Wilcoxon", "+ / - / 0", "p, signs"})
        head += tag("th", text(title));
    std::string rows;
    for (const ordered_json& row : pairs.begin().value()) {
        std::string cells;
        for (const ordered_json& cell : row) cells += tag("td", text(cell.get<std::string>()));
        rows += tag("tr", cells) + "\n";
    }
    const std::string shown = pairs.begin().key();
    const std::size_t comma = shown.find(',');
    return tag("p",
               choice("first", comparison, std::stoul(shown.substr(0, comma))) +
                   choice("second", comparison, std::stoul(shown.substr(comma + 1))),
               "bar") +
           "<div class=\"wide\"><table class=\"numbers\" id=\"pairs\">" +
           tag("thead", tag("tr", head)) + tag("tbody", rows) + "</table></div>\n" +
           tag("p",
               "Pairs are runs with the same seed and the same cloud. Difference: second - first, "
               "with the 95 % interval of the paired t test. p: the probability of such "
               "differences if the settings have the same effect, two-sided, by Wilcoxon's "
               "signed-rank test and by the sign test. With n pairs, the least p is 2 / 2^n.",
               "hint");
}

std::string comparison_data(const Comparison& comparison) {
    const ordered_json data = {{"runs", runs_data(comparison)},
                               {"groups", groups_data(comparison)},
                               {"pairs", all_pairs(comparison)}};
    return "<script type=\"application/json\" id=\"comparison\">" +
           html::json_in_script(data.dump(-1, ' ', false, ordered_json::error_handler_t::replace)) +
           "</script>\n";
}

}  // namespace dsc::report
