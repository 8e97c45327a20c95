// Texts of metrics.csv.
#include "dsc/run/metrics.hpp"

#include <dsc/text/numbers.hpp>

namespace dsc::run {

void append_cell(std::string& to, std::uint64_t value) { text::append_number(to, value); }

void append_cell(std::string& to, double value) { text::append_number(to, value); }

void append_cell(std::string& text, const std::optional<double>& value) {
    if (value) append_cell(text, *value);
}

std::string csv_header(const StepMetrics& row) {
    std::string text;
    for (const MetricsColumn& column : metrics_columns)
        (text += text.empty() ? "" : ",") += column.name;
    if (row.refinement) {
        for (const MetricsColumn& column : refinement_columns) (text += ",") += column.name;
    }
    for (const auto& [figure, value] : row.observers) text += "," + figure;
    return text + "\n";
}

std::string csv_row(const StepMetrics& row, std::size_t observer_columns) {
    std::string text;
    for (const MetricsColumn& column : metrics_columns) {
        if (!text.empty()) text += ",";
        column.append(text, row);
    }
    if (row.refinement) {
        for (const MetricsColumn& column : refinement_columns) column.append(text += ",", row);
    }
    for (const auto& [figure, value] : row.observers) append_cell(text += ",", value);
    for (std::size_t i = row.observers.size(); i < observer_columns; ++i) text += ",";
    return text + "\n";
}

}  // namespace dsc::run
