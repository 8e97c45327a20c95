// Reads the folder of a finished run.
#include "record.hpp"

#include <algorithm>
#include <charconv>

#include <dsc/base/error.hpp>
#include <dsc/base/read_file.hpp>
#include <dsc/config/yaml.hpp>
#include <dsc/run/run_folder.hpp>

namespace dsc::report {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

[[noreturn]] void no_run(const fs::path& folder, const std::string& cause) {
    throw IoError("report.no_run", folder.string(), "", cause,
                  "name the folder of a run that has ended (dsc run CONFIG -o DIR)");
}

ordered_json read_record_json(const fs::path& file) {
    ordered_json json = ordered_json::parse(read_file(file), nullptr, false);
    if (!json.is_object())
        throw IoError("report.damaged", file.string(), "", "is not a JSON object",
                      "run the experiment again");
    return json;
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    while (true) {
        const std::size_t comma = line.find(',');
        cells.push_back(line.substr(0, comma));
        if (comma == std::string_view::npos) return cells;
        line.remove_prefix(comma + 1);
    }
}

}  // namespace

const std::vector<double>* MetricsTable::find(std::string_view column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    return found == columns.end() ? nullptr
                                  : &values[static_cast<std::size_t>(found - columns.begin())];
}

MetricsTable parse_metrics(std::string_view csv, const std::string& file) {
    MetricsTable metrics;
    for (std::size_t number = 1; !csv.empty(); ++number) {
        const std::size_t end = std::min(csv.find('\n'), csv.size());
        const std::vector<std::string_view> cells = cells_of(csv.substr(0, end));
        csv.remove_prefix(std::min(end + 1, csv.size()));
        if (number == 1) {
            metrics.columns.assign(cells.begin(), cells.end());
            metrics.values.resize(cells.size());
            continue;
        }
        const auto damaged = [&](const std::string& cause) {
            throw IoError("report.metrics", file, std::to_string(number), cause,
                          "run the experiment again");
        };
        if (cells.size() != metrics.columns.size())
            damaged(std::to_string(cells.size()) + " cells for " +
                    std::to_string(metrics.columns.size()) + " columns");
        for (std::size_t i = 0; i < cells.size(); ++i) {
            double value = std::numeric_limits<double>::quiet_NaN();
            const char* const last = cells[i].data() + cells[i].size();
            if (!cells[i].empty()) {
                const auto [rest, error] = std::from_chars(cells[i].data(), last, value);
                if (error != std::errc() || rest != last)
                    damaged("a cell of column " + metrics.columns[i] + " is not a number");
            }
            metrics.values[i].push_back(value);
        }
    }
    return metrics;
}

const ordered_json* find(const ordered_json& root, std::string_view path) {
    const ordered_json* at = &root;
    while (!path.empty()) {
        const std::size_t dot = std::min(path.find('.'), path.size());
        if (!at->is_object()) return nullptr;
        const auto found = at->find(std::string(path.substr(0, dot)));
        if (found == at->end()) return nullptr;
        at = &*found;
        path.remove_prefix(std::min(dot + 1, path.size()));
    }
    return at;
}

double RunRecord::number(std::string_view path) const {
    const ordered_json* value = find(summary, path);
    return value != nullptr && value->is_number() ? value->get<double>()
                                                  : std::numeric_limits<double>::quiet_NaN();
}

std::string RunRecord::word(std::string_view path) const {
    const ordered_json* value = find(summary, path);
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

bool RunRecord::flag(std::string_view path) const {
    const ordered_json* value = find(summary, path);
    return value != nullptr && value->is_boolean() && value->get<bool>();
}

bool RunRecord::has(std::string_view path) const {
    const ordered_json* value = find(summary, path);
    return value != nullptr && !value->is_null();
}

cloud::Transform RunRecord::to_normalised() const {
    cloud::Transform transform;
    const double scale = number("to_normalised.scale");
    if (scale > 0.0) transform.scale = scale;
    const ordered_json* centre = find(summary, "to_normalised.centre");
    if (centre != nullptr) transform.centre = vector_of(*centre);
    const ordered_json* rows = find(summary, "to_normalised.rotation");
    if (rows != nullptr && rows->is_array() && rows->size() == 3) {
        Eigen::Matrix3d rotation;
        for (int row = 0; row < 3; ++row)
            rotation.row(row) = vector_of((*rows)[static_cast<std::size_t>(row)]).transpose();
        transform.rotation = rotation;
    }
    return transform;
}

bool RunRecord::several_labels() const {
    const ordered_json* labels = find(summary, "labels");
    if (labels == nullptr || !labels->is_object()) return false;
    return std::any_of(labels->begin(), labels->end(),
                       [](const ordered_json& label) { return label.contains("surface"); });
}

Vec3 vector_of(const ordered_json& list) {
    Vec3 vector = Vec3::Zero();
    if (!list.is_array() || list.size() != 3) return vector;
    for (std::size_t k = 0; k < 3; ++k) {
        if (list[k].is_number()) vector[static_cast<Eigen::Index>(k)] = list[k].get<double>();
    }
    return vector;
}

RunRecord read_record(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) no_run(folder, "is not a folder");
    if (!run::RunFolder::is_ours(folder))
        no_run(folder,
               "no run wrote this folder: status.json is missing or was not written by dsc");
    if (!fs::exists(folder / "summary.json", error))
        no_run(folder, "the run has no result: it failed or has not ended, see status.json");
    RunRecord record;
    record.folder = folder;
    record.summary = read_record_json(folder / "summary.json");
    record.provenance = read_record_json(folder / "provenance.json");
    const fs::path metrics = folder / "metrics.csv";
    record.metrics = parse_metrics(read_file(metrics), metrics.string());
    record.config = read_file(folder / "config.resolved.yaml");
    // The values in this file are final: `${` is ordinary text.
    config::YamlOptions options;
    options.environment = [](const std::string&) { return std::optional<std::string>(); };
    record.resolved =
        config::parse_yaml(record.config, (folder / "config.resolved.yaml").string(), options);
    return record;
}

}  // namespace dsc::report
