// The section of a report on how well the surface explains its points.
#include "html.hpp"
#include "sections.hpp"

namespace dsc::report {

using html::real;
using html::tag;
using nlohmann::ordered_json;

std::string coverage_section(const RunRecord& record) {
    if (!record.has("coverage")) return "";
    const cloud::Transform to_normalised = record.to_normalised();
    const double width = record.number("cloud.point_width"), scale = to_normalised.scale;
    const auto percent = [&](const char* path) { return real(100.0 * record.number(path)) + " %"; };
    std::vector<html::Row> rows = {
        {"points farther from the surface than 3 noise scales and 1 spacing",
         percent("coverage.far_share")},
        {"largest distance of a point from the surface",
         real(record.number("coverage.largest_distance") / width) + " spacings"},
        {"area of the surface without a point within 3 spacings",
         percent("coverage.unsupported_share")},
        {"mean edge of the surface", real(record.number("coverage.edge_to_spacing")) + " spacings"},
        {"spacing, root of the area per point",
         real(width / scale) + ", in the units of the input"}};
    if (record.has("trimmed"))
        rows.push_back({"area removed by trimming", percent("trimmed.area_share")});
    std::string body = html::table({"how well the surface explains its points", ""}, rows);
    std::vector<html::Row> groups;
    const ordered_json* told = find(record.summary, "coverage.groups_of_far_points");
    if (told != nullptr && told->is_array()) {
        for (const ordered_json& group : *told) {
            html::Row row = {html::integer(group.value("points", 0.0))};
            const Vec3 at = to_normalised.inverse(vector_of(group.at("centre")));
            std::string place;
            for (int k = 0; k < 3; ++k) place += (k == 0 ? "" : ", ") + real(at[k]);
            row.push_back(place);
            row.push_back(real(group.value("diameter", 0.0) / scale));
            row.push_back(real(group.value("farthest", 0.0) / scale));
            groups.push_back(std::move(row));
        }
    }
    if (!groups.empty()) {
        body += tag("p", "Groups of points without a surface, in the units of the input:") + "\n" +
                html::table({"points", "centre", "diameter", "largest distance"}, groups);
    }
    return section(
        "Points and surface",
        body + tag("p",
                   "The viewer can colour the surface by gap (the distance to the nearest point, "
                   "in spacings) and by support, if the velocity publishes them.",
                   "hint"));
}

}  // namespace dsc::report
