// Reads the runs of a comparison and names them.
#include "compared.hpp"

#include <algorithm>
#include <limits>

#include <dsc/config/yaml.hpp>

#include "html.hpp"
#include "plot.hpp"

namespace dsc::report {
namespace {

namespace fs = std::filesystem;

std::string scalar_text(const config::ConfigNode& node) {
    if (node.is_null()) return "none";
    if (node.is_boolean()) return node.as_boolean() ? "true" : "false";
    if (node.is_integer()) return std::to_string(node.as_integer());
    if (node.is_real()) return config::real_text(node.as_real());
    if (node.is_string()) return node.as_string();
    return "empty";
}

/// The scalar values of a configuration by their dotted paths.
void collect_values(const config::ConfigNode& node, std::vector<std::string>& order,
                    std::map<std::string, std::string>& out) {
    if (node.is_map() && node.size() > 0) {
        for (const config::ConfigEntry& entry : node.entries())
            collect_values(entry.value, order, out);
    } else if (node.is_list() && node.size() > 0) {
        for (const config::ConfigNode& item : node.items()) collect_values(item, order, out);
    } else {
        const std::string path = node.path();
        if (out.emplace(path, scalar_text(node)).second) order.push_back(path);
    }
}

/// Whether a value has no influence on the result, so that runs with other values are repeats.
bool is_label(const std::string& path) {
    if (path == "name" || path == "plugins" || path.rfind("plugins.", 0) == 0) return true;
    return path.rfind("output.", 0) == 0 && path.rfind("output.trim", 0) != 0;
}

/// All paths, each once, in the order in which the experiments have them.
std::vector<std::string> merged(const std::vector<std::vector<std::string>>& orders) {
    std::vector<std::string> all;
    std::map<std::string, int> known;
    for (const std::vector<std::string>& order : orders) {
        for (const std::string& path : order) {
            if (++known[path] == 1) all.push_back(path);
        }
    }
    return all;
}

bool differs(const std::vector<Compared>& runs, const std::string& path) {
    return std::any_of(runs.begin(), runs.end(), [&](const Compared& run) {
        return run.value(path) != runs.front().value(path);
    });
}

/// The overrides of a sweep that differ; a run without one of them has the value of the base.
std::vector<std::string> differing_overrides(std::span<const ComparedRun> given,
                                             std::vector<Compared>& runs) {
    std::vector<std::vector<std::string>> orders;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        std::vector<std::string>& order = orders.emplace_back();
        for (const auto& [path, value] : given[i].overrides) {
            order.push_back(path);
            runs[i].values.emplace(path, value);  // a whole map is not a value of the experiment
        }
    }
    std::vector<std::string> keys;
    for (const std::string& path : merged(orders)) {
        if (differs(runs, path)) keys.push_back(path);
    }
    return keys;
}

/// "alpha=0.2, seed=1"
std::string joined(const Comparison& comparison, const Compared& run,
                   const std::vector<std::string>& keys) {
    std::string text;
    for (const std::string& key : keys) {
        std::string value = run.value(key);
        if (key == "truth" || key.ends_with("file")) value = fs::path(value).filename().string();
        text += (text.empty() ? "" : ", ") + comparison.short_key(key) + "=" + value;
    }
    return text;
}

void name_runs(Comparison& comparison) {
    std::vector<fs::path> folders;
    for (const Compared& run : comparison.runs) folders.push_back(run.record.folder);
    const std::vector<std::string> parts = distinct_parts(folders);
    std::map<std::string, int> seen;
    for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
        Compared& run = comparison.runs[i];
        run.name = comparison.sweep ? joined(comparison, run, comparison.keys) : parts[i];
        if (run.name.empty()) run.name = parts[i];
        const int count = ++seen[run.name];
        if (count > 1) run.name += " (" + std::to_string(count) + ")";
    }
}

}  // namespace

double Compared::figure(const std::string& path) const {
    if (path.rfind("truth.", 0) != 0) return record.number(path);
    for (const auto& [key, found] : truth) {
        if (path.compare(6, std::string::npos, key) == 0) return found;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

std::string Compared::value(const std::string& path) const {
    const auto found = values.find(path);
    return found == values.end() ? "-" : found->second;
}

std::size_t Comparison::settings() const {
    std::size_t count = 0;
    for (const statistics::Group& group : groups) count = std::max(count, group.setting + 1);
    return count;
}

std::string Comparison::short_key(const std::string& path) const {
    for (std::size_t dot = path.rfind('.'); dot != std::string::npos && dot > 0;
         dot = path.rfind('.', dot - 1)) {
        const std::string end = path.substr(dot);
        const auto same = std::count_if(keys.begin(), keys.end(),
                                        [&](const std::string& key) { return key.ends_with(end); });
        // A number alone says nothing: "schedule.0.steps" is "0.steps" only if needed.
        if (same <= 1 && end.find_first_not_of(".0123456789") != std::string::npos)
            return end.substr(1);
    }
    return path;
}

std::string Comparison::group_name(const statistics::Group& group) const {
    std::vector<std::string> without_seed;
    for (const std::string& key : keys) {
        if (key != "seed") without_seed.push_back(key);
    }
    const Compared& first = runs[group.runs.front()];
    if (without_seed.empty() || !sweep) {
        return group.runs.size() > 1
                   ? first.name + " and " + std::to_string(group.runs.size() - 1) + " more"
                   : first.name;
    }
    return joined(*this, first, without_seed);
}

std::string Comparison::setting_name(std::size_t setting) const {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const statistics::Group& g) {
        return g.setting == setting;
    });
    std::vector<std::string> kept;
    for (const std::string& key : keys) {
        if (key != "seed" && !statistics::is_data_key(key)) kept.push_back(key);
    }
    if (!sweep || kept.empty()) return group_name(*group);
    return joined(*this, runs[group->runs.front()], kept);
}

std::vector<std::size_t> Comparison::shown() const {
    std::vector<std::size_t> first;
    for (const statistics::Group& group : groups) {
        if (first.size() < most_colours) first.push_back(group.runs.front());
    }
    std::sort(first.begin(), first.end());
    return first;
}

Comparison compare_runs(std::span<const ComparedRun> given) {
    std::vector<ComparedRun> ordered(given.begin(), given.end());
    Comparison comparison;
    comparison.sweep = std::all_of(ordered.begin(), ordered.end(),
                                   [](const ComparedRun& run) { return run.index.has_value(); });
    if (comparison.sweep) {
        std::stable_sort(ordered.begin(), ordered.end(),
                         [](const auto& a, const auto& b) { return *a.index < *b.index; });
    }
    std::vector<std::vector<std::string>> orders;
    for (std::size_t i = 0; i < ordered.size(); ++i) {
        Compared& run = comparison.runs.emplace_back();
        run.record = read_record(ordered[i].folder);
        run.index = comparison.sweep ? *ordered[i].index : i;
        run.truth = ordered[i].truth;
        collect_values(run.record.resolved, orders.emplace_back(), run.values);
        std::vector<statistics::KeyValue> values;
        for (const auto& value : run.values) {
            if (!is_label(value.first)) values.push_back(value);
        }
        comparison.identities.push_back(statistics::identity_of(values));
    }
    comparison.paths = merged(orders);
    comparison.groups = statistics::group_runs(comparison.identities);
    for (const std::string& path : comparison.paths) {
        if (differs(comparison.runs, path)) comparison.differ.push_back(path);
    }
    comparison.keys =
        comparison.sweep ? differing_overrides(ordered, comparison.runs) : comparison.differ;
    name_runs(comparison);
    return comparison;
}

std::vector<std::string> distinct_parts(const std::vector<fs::path>& paths) {
    std::vector<std::vector<std::string>> parts;
    for (const fs::path& path : paths) {
        std::vector<std::string>& of_path = parts.emplace_back();
        for (const fs::path& part : fs::absolute(path).lexically_normal()) {
            if (!part.empty()) of_path.push_back(part.string());
        }
    }
    const auto same = [&](const auto& part) {
        return std::all_of(parts.begin(), parts.end(), [&](const auto& of_path) {
            return of_path.size() > 1 && part(of_path) == part(parts.front());
        });
    };
    const auto front = [](const auto& of_path) { return of_path.front(); };
    const auto back = [](const auto& of_path) { return of_path.back(); };
    while (same(front)) {
        for (auto& of_path : parts) of_path.erase(of_path.begin());
    }
    while (same(back)) {
        for (auto& of_path : parts) of_path.pop_back();
    }
    std::vector<std::string> texts;
    for (const auto& of_path : parts) {
        std::string text;
        for (const std::string& part : of_path) text += (text.empty() ? "" : "/") + part;
        texts.push_back(text.empty() ? "/" : text);
    }
    return texts;
}

}  // namespace dsc::report
