// Tables 6.1 and 6.2 of the thesis for one run or for several.
#include "thesis.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "html.hpp"
#include "sections.hpp"

namespace dsc::report {
namespace {

using html::integer;
using html::real;
using html::seconds;
using html::tag;

/// The rows of tables 6.1 and 6.2 of the thesis [Saul2015]: seconds, vertices, faces; mean, least
/// and largest distance.
struct ThesisRow {
    const char* mesh;
    double seconds, vertices, faces, mean, least, largest;
};
constexpr std::array<ThesisRow, 3> thesis_rows = {
    {{"bunny", 946, 5063, 10154, 0.02915, 0.00015, 0.11350},
     {"teapot", 845, 2550, 5110, 0.03291, 0.00034, 0.10509},
     {"cow", 893, 2355, 4848, 0.02443, 0.00026, 0.16622}}};

/// The row of the thesis for the cloud of a run; null for any other cloud.
const ThesisRow* row_of(const RunRecord& record) {
    const std::string mesh = std::filesystem::path(record.word("input.source")).stem().string();
    const auto* const found = std::find_if(thesis_rows.begin(), thesis_rows.end(),
                                           [&](const ThesisRow& row) { return mesh == row.mesh; });
    return found == thesis_rows.end() ? nullptr : found;
}

constexpr const char* times_title = "Time and size (table 6.1)";
constexpr const char* distances_title =
    "From the vertices of the surface to the cloud, normalised units (table 6.2)";

}  // namespace

std::string thesis_section(const RunRecord& record) {
    std::vector<html::Row> times = {
        {record.name(), seconds(record.number("wall_s")), seconds(record.number("cpu_s")),
         integer(record.number("interface_vertices")), integer(record.number("interface_faces"))}};
    std::vector<html::Row> distances;
    if (record.has("vertex_to_cloud")) {
        distances.push_back(
            {record.name(), real(record.number("vertex_to_cloud.mean")),
             real(record.number("vertex_to_cloud.min")), real(record.number("vertex_to_cloud.max")),
             integer(record.number("shells")) + " / " + integer(record.number("genus")),
             integer(record.number("self_intersections"))});
        for (const ThesisRow& row : thesis_rows) {
            times.push_back({"thesis: " + std::string(row.mesh), integer(row.seconds) + " s", "-",
                             integer(row.vertices), integer(row.faces)});
            distances.push_back({"thesis: " + std::string(row.mesh), real(row.mean),
                                 real(row.least), real(row.largest), "-", "-"});
        }
    }
    std::string body = tag("h3", times_title) + "\n" +
                       html::table({"mesh", "wall time", "CPU time", "vertices", "faces"}, times);
    if (!distances.empty()) {
        body += tag("h3", distances_title) + "\n" +
                html::table(
                    {"mesh", "mean", "least", "largest", "shells / genus", "self-intersections"},
                    distances);
    }
    return section("The thesis' tables", body, "thesis");
}

std::string thesis_comparison(std::span<const NamedRecord> runs) {
    html::Row of_times = {"run", "mesh"}, of_distances = {"run", "mesh"};
    for (const char* figure : {"wall time", "CPU time", "vertices", "faces"})
        of_times.push_back(figure);
    of_times.insert(of_times.end(), {"seconds, thesis", "vertices, thesis", "faces, thesis"});
    of_distances.insert(of_distances.end(),
                        {"mean", "mean, thesis", "least", "least, thesis", "largest",
                         "largest, thesis", "shells / genus", "self-intersections"});
    std::vector<html::Row> times, distances;
    for (const NamedRecord& run : runs) {
        const RunRecord& record = *run.record;
        const ThesisRow* thesis = row_of(record);
        const auto of_thesis = [&](double ThesisRow::*figure, bool whole) {
            if (thesis == nullptr) return std::string("-");
            return whole ? integer(thesis->*figure) : real(thesis->*figure);
        };
        const std::string mesh = thesis != nullptr ? thesis->mesh : "-";
        times.push_back(
            {run.name, mesh, seconds(record.number("wall_s")), seconds(record.number("cpu_s")),
             integer(record.number("interface_vertices")),
             integer(record.number("interface_faces")), of_thesis(&ThesisRow::seconds, true),
             of_thesis(&ThesisRow::vertices, true), of_thesis(&ThesisRow::faces, true)});
        if (!record.has("vertex_to_cloud")) continue;
        distances.push_back(
            {run.name, mesh, real(record.number("vertex_to_cloud.mean")),
             of_thesis(&ThesisRow::mean, false), real(record.number("vertex_to_cloud.min")),
             of_thesis(&ThesisRow::least, false), real(record.number("vertex_to_cloud.max")),
             of_thesis(&ThesisRow::largest, false),
             integer(record.number("shells")) + " / " + integer(record.number("genus")),
             integer(record.number("self_intersections"))});
    }
    std::string body = tag("h3", times_title) + "\n" + html::table(of_times, times);
    if (!distances.empty())
        body += tag("h3", distances_title) + "\n" + html::table(of_distances, distances);
    return body;
}

}  // namespace dsc::report
