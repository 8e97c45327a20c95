// The section of a report about the refinements of the run.
#include <limits>

#include "html.hpp"
#include "sections.hpp"

namespace dsc::report {
namespace {

double number(const nlohmann::ordered_json& item, const char* key) {
    const auto found = item.find(key);
    return found != item.end() && found->is_number() ? found->get<double>()
                                                     : std::numeric_limits<double>::quiet_NaN();
}

html::Row row_of(const nlohmann::ordered_json& item) {
    const auto type = item.find("type");
    html::Row row = {"schedule." + html::integer(number(item, "item")) + " " +
                     (type != item.end() && type->is_string() ? type->get<std::string>() : "")};
    for (const char* key : {"calls", "skipped", "requested", "committed", "vertices_made",
                            "vertices_followed", "vertices_present"})
        row.push_back(html::integer(number(item, key)));
    return row;
}

}  // namespace

std::string refinement_section(const RunRecord& record) {
    const nlohmann::ordered_json* items = find(record.summary, "refinements.items");
    if (items == nullptr || !items->is_array() || items->empty()) return "";
    std::vector<html::Row> rows;
    for (const nlohmann::ordered_json& item : *items) {
        if (item.is_object()) rows.push_back(row_of(item));
    }
    return section("Refinements",
                   html::table({"item", "runs", "skipped", "changes requested", "committed",
                                "vertices made", "followed for five steps", "still present"},
                               rows) +
                       html::tag("p", "Followed are the vertices that were made at least five "
                                      "steps before the end of the run; present are those of them "
                                      "that were still on the interface five steps after they "
                                      "were made."));
}

}  // namespace dsc::report
