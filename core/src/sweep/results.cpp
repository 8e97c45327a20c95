// Tables and comparisons of the results of a sweep.
#include "dsc/sweep/results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <dsc/base/error.hpp>
#include <dsc/config/overrides.hpp>
#include <dsc/statistics/groups.hpp>
#include <dsc/text/numbers.hpp>

#include "table.hpp"

namespace dsc::sweep {
namespace {

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
std::string value_text(const config::ConfigNode& value) {
    return value.is_string() ? value.as_string() : config::flow_text(value);
}

std::string override_cell(const PointResult& point, const std::string& path) {
    const config::ConfigNode* value = point.overrides.find(path);
    return value == nullptr ? std::string() : cell(value_text(*value));
}

/// NaN for a point that is not finished and for what is not a number.
double figure_of(const PointResult& point, const std::string& name) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto found = point.figures.find(name);
    if (point.status == "done" && found != point.figures.end())
        text::parse_number(found->second, value);
    return value;
}

std::vector<statistics::Identity> identities(const std::vector<PointResult>& points) {
    std::vector<statistics::Identity> all;
    for (const PointResult& point : points) {
        std::vector<statistics::KeyValue> values;
        for (const config::ConfigEntry& entry : point.overrides.entries())
            values.emplace_back(entry.key, value_text(entry.value));
        all.push_back(statistics::identity_of(values));
    }
    return all;
}

std::string number_cell(double value) { return std::isfinite(value) ? text::exact(value) : ""; }

/// The overrides of a setting: without seed and cloud.
std::string setting_text(const PointResult& point) {
    std::vector<config::ConfigEntry> kept;
    for (const config::ConfigEntry& entry : point.overrides.entries()) {
        if (entry.key != "seed" && !statistics::is_data_key(entry.key)) kept.push_back(entry);
    }
    return config::flow_text(config::ConfigNode::map(std::move(kept)));
}

}  // namespace

std::string results_csv(const SweepResults& results) {
    std::string text = "index,folder,status,ended,error";
    for (const std::string& name : results.overrides) text += "," + cell(name);
    for (const std::string& name : results.figures) text += "," + cell(name);
    text += "\n";
    for (std::size_t i = 0; i < results.points.size(); ++i) {
        const PointResult& point = results.points[i];
        text += std::to_string(i) + "," + point_folder(point.name) + "," + cell(point.status) +
                "," + cell(point.ended) + "," + cell(point.error);
        for (const std::string& name : results.overrides) text += "," + override_cell(point, name);
        for (const std::string& name : results.figures) {
            const auto found = point.figures.find(name);
            text += "," + (found == point.figures.end() ? std::string() : found->second);
        }
        text += "\n";
    }
    return text;
}

std::string groups_csv(const SweepResults& results) {
    std::string text = "group,setting,n";
    for (const std::string& name : results.overrides) {
        if (name != "seed") text += "," + cell(name);
    }
    for (const std::string& name : results.figures) {
        for (const char* part : {".mean", ".deviation", ".low", ".high"})
            text += "," + cell(name + part);
    }
    text += "\n";
    const std::vector<statistics::Group> groups =
        statistics::group_runs(identities(results.points));
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const PointResult& first = results.points[groups[g].runs.front()];
        const auto done =
            std::count_if(groups[g].runs.begin(), groups[g].runs.end(),
                          [&](std::size_t i) { return results.points[i].status == "done"; });
        text += std::to_string(g) + "," + std::to_string(groups[g].setting) + "," +
                std::to_string(done);
        for (const std::string& name : results.overrides) {
            if (name != "seed") text += "," + override_cell(first, name);
        }
        for (const std::string& name : results.figures) {
            std::vector<double> values;
            for (const std::size_t i : groups[g].runs)
                values.push_back(figure_of(results.points[i], name));
            const statistics::Sample sample = statistics::summarise(values);
            for (const double value : {sample.mean, sample.deviation, sample.low, sample.high})
                text += "," + number_cell(value);
        }
        text += "\n";
    }
    return text;
}

SettingsComparison compare_settings(const SweepResults& results, std::size_t first,
                                    std::size_t second) {
    const std::vector<statistics::Identity> runs = identities(results.points);
    const std::vector<statistics::Group> groups = statistics::group_runs(runs);
    const auto first_run = [&](std::size_t setting) {
        const auto group =
            std::find_if(groups.begin(), groups.end(),
                         [&](const statistics::Group& g) { return g.setting == setting; });
        if (group == groups.end())
            throw UsageError("sweep.setting", "setting " + std::to_string(setting),
                             "the sweep has no setting with this number",
                             "dsc sweep collect DIR --groups FILE lists the settings");
        return group->runs.front();
    };
    const std::size_t a = first_run(first), b = first_run(second);
    SettingsComparison comparison{
        setting_text(results.points[a]), setting_text(results.points[b]), 0, {}};
    auto pairs = statistics::pair_runs(runs, runs[a].setting, runs[b].setting);
    std::erase_if(pairs, [&](const auto& pair) {
        return results.points[pair.first].status != "done" ||
               results.points[pair.second].status != "done";
    });
    if (pairs.empty())
        throw UsageError("sweep.pairs",
                         "settings " + std::to_string(first) + " and " + std::to_string(second),
                         "they have no finished points with the same seed and the same cloud",
                         "run both settings with the same seeds");
    comparison.pairs = pairs.size();
    for (const std::string& name : results.figures) {
        std::vector<double> of_first, of_second;
        for (const auto& [i, j] : pairs) {
            of_first.push_back(figure_of(results.points[i], name));
            of_second.push_back(figure_of(results.points[j], name));
        }
        const statistics::PairedComparison found = statistics::compare_pairs(of_first, of_second);
        if (found.difference.n > 0) comparison.figures.emplace_back(name, found);
    }
    return comparison;
}

}  // namespace dsc::sweep
