#pragma once
// A finished run as its folder tells it: all that a report is made of.

#include <dsc/config/node.hpp>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dsc::run {

/// metrics.csv by columns; an empty cell is NaN.
struct MetricsTable {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> values;

    /// Null where there is no such column.
    const std::vector<double>* find(std::string_view column) const;
    std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
};

/// Throws IoError "report.metrics" for a table that is none; `file` is for the message.
MetricsTable parse_metrics(std::string_view csv, const std::string& file);

struct RunRecord {
    std::filesystem::path folder;
    nlohmann::ordered_json summary;
    nlohmann::ordered_json provenance;
    MetricsTable metrics;
    std::string config;  ///< text of config.resolved.yaml
    config::ConfigNode resolved;

    /// A value of the summary by its path, "vertex_to_cloud.mean"; NaN, an empty text, false where there is none.
    double number(std::string_view path) const;
    std::string word(std::string_view path) const;
    bool flag(std::string_view path) const;
    /// Whether there is a value other than null.
    bool has(std::string_view path) const;
    std::string name() const { return word("name"); }
    /// Of several labels above 0: the interface is no manifold where they meet, each label has a surface.
    bool several_labels() const;
};

/// Value at a dotted path; null where there is none.
const nlohmann::ordered_json* find(const nlohmann::ordered_json& root, std::string_view path);

/// Reads them. Throws IoError "report.no_run" for a folder that is no run's or of a run without a result, "report.damaged" for
/// a file that does not parse, and what readers throw. [setup]
RunRecord read_record(const std::filesystem::path& folder);

}  // namespace dsc::run
