#pragma once
// metrics.csv: the figures of one step, and the table that declares every column once.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace dsc::run {

/// The figures of the refinements of a run in one row: those between the step before and the row's
/// step, and what is left of those five steps ago.
struct RefinementRow {
    std::uint64_t requested = 0;
    std::uint64_t committed = 0;
    std::uint64_t made = 0;
    std::optional<double> present;
};

/// A row of metrics.csv, normalised units; metrics_columns says what each figure means. Row 0 is
/// the state before the first step.
struct StepMetrics {
    std::uint64_t step = 0;
    std::size_t interface_vertices = 0;
    std::size_t interface_faces = 0;
    std::size_t junction_vertices = 0;
    std::size_t tets = 0;
    double mean_edge = 0.0;
    double mean_speed = 0.0;
    double max_speed = 0.0;
    std::optional<double> vertex_to_cloud_mean;
    std::optional<double> vertex_to_cloud_max;
    std::optional<double> cloud_to_surface_mean;
    double volume = 0.0;
    double min_tet_quality = 0.0;
    unsigned rounds = 0;
    std::size_t requested = 0;
    std::size_t arrived = 0;
    std::size_t clamped = 0;
    double dropped_motion = 0.0;
    double edit_volume = 0.0;
    double relabelled_volume = 0.0;
    std::uint64_t committed = 0;
    std::size_t events = 0;
    std::optional<RefinementRow> refinement;  ///< in all rows if the schedule contains a
                                              ///< refinement, else in none
    std::vector<std::pair<std::string, double>> observers;  ///< "observers.ID.figure"; the last
                                                            ///< columns
};

/// Cloud points at which cloud_to_surface_mean is measured per step; the summary uses all of them.
inline constexpr std::size_t cloud_probes = 150;

/// Appends a cell: an integer, or a number in the shortest form that reads back to the same double;
/// nothing if it is empty.
void append_cell(std::string& text, std::uint64_t value);
void append_cell(std::string& text, double value);
void append_cell(std::string& text, const std::optional<double>& value);

/// Appends the cell of one figure of a row.
template <auto Figure>
void append_figure(std::string& text, const StepMetrics& row) {
    const auto& value = row.*Figure;
    if constexpr (std::is_integral_v<std::decay_t<decltype(value)>>) {
        append_cell(text, std::uint64_t{value});
    } else {
        append_cell(text, value);
    }
}

/// A column of metrics.csv.
struct MetricsColumn {
    std::string_view name;
    std::string_view unit;  ///< "n": normalised units; "-": a number without a unit
    std::string_view meaning;
    void (*append)(std::string& text, const StepMetrics& row);  ///< appends the row's cell
};

/// The columns in their order; those of refinements and the figures of observers follow. Header
/// line, rows, reports and documentation use this table.
inline constexpr std::array<MetricsColumn, 22> metrics_columns = {{
    {"step", "-", "number of the step; 0 is the state before the first step",
     append_figure<&StepMetrics::step>},
    {"interface_vertices", "-", "vertices of the interface",
     append_figure<&StepMetrics::interface_vertices>},
    {"interface_faces", "-", "faces of the interface",
     append_figure<&StepMetrics::interface_faces>},
    {"junction_vertices", "-",
     "interface vertices where three labels or more meet; they do not move",
     append_figure<&StepMetrics::junction_vertices>},
    {"tets", "-", "tets, inside and outside", append_figure<&StepMetrics::tets>},
    {"mean_edge", "n", "mean length of the interface edges",
     append_figure<&StepMetrics::mean_edge>},
    {"mean_speed", "n per step", "mean length of the displacements of the movable vertices",
     append_figure<&StepMetrics::mean_speed>},
    {"max_speed", "n per step", "largest length of these displacements",
     append_figure<&StepMetrics::max_speed>},
    {"vertex_to_cloud_mean", "n",
     "mean distance of the interface vertices to their nearest cloud points; empty without a cloud",
     append_figure<&StepMetrics::vertex_to_cloud_mean>},
    {"vertex_to_cloud_max", "n", "largest of these distances; empty without a cloud",
     append_figure<&StepMetrics::vertex_to_cloud_max>},
    {"cloud_to_surface_mean", "n",
     "mean distance of at most 150 cloud points, evenly selected, to the surface; empty without a "
     "cloud",
     append_figure<&StepMetrics::cloud_to_surface_mean>},
    {"volume", "n^3", "volume of all labels above 0", append_figure<&StepMetrics::volume>},
    {"min_tet_quality", "-", "least quality of a tet",
     append_figure<&StepMetrics::min_tet_quality>},
    {"rounds", "-", "repair rounds of the step", append_figure<&StepMetrics::rounds>},
    {"requested", "-", "vertices with a displacement", append_figure<&StepMetrics::requested>},
    {"arrived", "-", "vertices that reached their destination",
     append_figure<&StepMetrics::arrived>},
    {"clamped", "-", "destinations moved back into the box shrunk by 2 L",
     append_figure<&StepMetrics::clamped>},
    {"dropped_motion", "n", "sum of the distances to destinations that were not reached",
     append_figure<&StepMetrics::dropped_motion>},
    {"edit_volume", "n^3", "sum of the volumes by which edits changed phases",
     append_figure<&StepMetrics::edit_volume>},
    {"relabelled_volume", "n^3", "sum of the volumes of relabelled tets, topology changes included",
     append_figure<&StepMetrics::relabelled_volume>},
    {"committed", "-", "operations that were committed in the step",
     append_figure<&StepMetrics::committed>},
    {"events", "-", "topology changes in the step", append_figure<&StepMetrics::events>},
}};

/// Appends the cell of one figure of the row's refinements.
template <auto Figure>
void append_refinement(std::string& text, const StepMetrics& row) {
    if (row.refinement) append_cell(text, (*row.refinement).*Figure);
}

/// The columns of a run with a refinement; they follow metrics_columns.
inline constexpr std::array<MetricsColumn, 4> refinement_columns = {{
    {"refine_requested", "-", "changes that refinements requested since the step before",
     append_refinement<&RefinementRow::requested>},
    {"refine_committed", "-", "those of them that were committed",
     append_refinement<&RefinementRow::committed>},
    {"refine_made", "-", "vertices of the interface that these refinements made",
     append_refinement<&RefinementRow::made>},
    {"refine_present", "-",
     "vertices that refinements made five steps before and that are still on the interface; empty "
     "if there was no refinement then",
     append_refinement<&RefinementRow::present>},
}};

/// The name of the column of a figure, for code that reads metrics.csv:
/// column_name<&StepMetrics::volume>. It does not compile for a figure that has no column.
template <auto Figure>
inline constexpr std::string_view column_name = [] {
    std::size_t i = 0;
    while (metrics_columns[i].append != &append_figure<Figure>) ++i;
    return metrics_columns[i].name;
}();

/// First line of metrics.csv for rows like `row`, with its newline.
std::string csv_header(const StepMetrics& row);
/// The row with its newline. Missing figures of observers, as in row 0, become empty cells up to
/// `observer_columns`.
std::string csv_row(const StepMetrics& row, std::size_t observer_columns = 0);

}  // namespace dsc::run
