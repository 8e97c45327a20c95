#pragma once
// A finished run as its folder contains it: the data of a report.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <dsc/cloud/normalize.hpp>
#include <dsc/config/node.hpp>

namespace dsc::report {

/// metrics.csv by columns; an empty cell becomes NaN.
struct MetricsTable {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> values;

    /// Null if there is no such column.
    const std::vector<double>* find(std::string_view column) const;
    std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
};

/// Throws IoError "report.metrics" for text that is not such a table; `file` is used in the
/// message.
MetricsTable parse_metrics(std::string_view csv, const std::string& file);

struct RunRecord {
    std::filesystem::path folder;
    nlohmann::ordered_json summary;
    nlohmann::ordered_json provenance;
    MetricsTable metrics;
    std::string config;  ///< text of config.resolved.yaml
    config::ConfigNode resolved;

    /// A value of the summary by its path, "vertex_to_cloud.mean"; NaN, an empty text or false if
    /// there is none.
    double number(std::string_view path) const;
    std::string word(std::string_view path) const;
    bool flag(std::string_view path) const;
    /// Whether there is a value other than null.
    bool has(std::string_view path) const;
    std::string name() const { return word("name"); }
    /// From the input's units to normalised units; the identity if the summary does not say.
    cloud::Transform to_normalised() const;
    /// Whether there are several labels above 0. The interface is not a manifold where they meet;
    /// each label has its own surface.
    bool several_labels() const;
};

/// Value at a dotted path; null if there is none.
const nlohmann::ordered_json* find(const nlohmann::ordered_json& root, std::string_view path);

/// The numbers of a list of three; zero for anything else.
Vec3 vector_of(const nlohmann::ordered_json& list);

/// Reads the files. Throws IoError "report.no_run" for a folder that no run wrote or whose run has
/// no result, "report.damaged" for a file that cannot be parsed, and what readers throw. [setup]
RunRecord read_record(const std::filesystem::path& folder);

}  // namespace dsc::report
