// The checks and warnings at the top of a report.
#include "warnings.hpp"

#include "html.hpp"

namespace dsc::report {
namespace {

using nlohmann::ordered_json;

Check zero(const RunRecord& record, const std::string& name, const std::string& path) {
    const double value = record.number(path);
    return {name, html::integer(value), value == 0.0};
}

/// If there are several labels above 0, each label has a closed surface, but the interface as a
/// whole is not closed.
void add_labels(const RunRecord& record, std::vector<Check>& checks) {
    for (const auto& [label, figures] : record.summary["labels"].items()) {
        const ordered_json* surface = find(figures, "surface");
        if (surface == nullptr || !surface->is_object()) continue;
        const bool closed = surface->value("closed_manifold", false);
        const double crossings = surface->value("self_intersections", -1.0);
        checks.push_back({"surface of label " + label,
                          closed ? "a closed manifold" : "not a closed manifold", closed});
        checks.push_back(
            {"self-intersections of label " + label, html::integer(crossings), crossings == 0.0});
    }
}

}  // namespace

std::vector<Check> validity(const RunRecord& record) {
    std::vector<Check> checks = {zero(record, "inverted tets", "inverted_tets")};
    if (record.number("interface_faces") > 0) {
        if (record.several_labels()) {
            add_labels(record, checks);
        } else {
            if (record.has("trimmed"))
                checks.push_back(
                    {"boundary edges",
                     html::integer(record.number("boundary_edges")) + ", open by request", true});
            else
                checks.push_back(zero(record, "boundary edges", "boundary_edges"));
            checks.push_back(zero(record, "non-manifold edges", "nonmanifold_edges"));
            checks.push_back(zero(record, "non-manifold vertices", "nonmanifold_vertices"));
            checks.push_back(zero(record, "self-intersections", "self_intersections"));
        }
    }
    const bool conforms = record.flag("surface_is_interface_of_volume");
    checks.push_back({record.has("trimmed")
                          ? "surface is the part of the volume's interface that points support"
                          : "surface is the interface of the volume",
                      conforms ? "bit for bit" : "no", conforms});
    return checks;
}

std::vector<std::string> warnings(const RunRecord& record) {
    std::vector<std::string> out;
    if (const ordered_json* told = find(record.summary, "warnings");
        told != nullptr && told->is_array()) {
        for (const ordered_json& warning : *told) {
            if (warning.is_object()) out.push_back(warning.value("text", std::string()));
        }
    }
    const std::string status = record.word("status");
    if (status == "stalled")
        out.push_back(
            "The run stalled: the surface could not move further; the result is the last state.");
    if (status == "cancelled")
        out.push_back(
            "The run was stopped before the end of its schedule; the result is the last state.");
    if (!(record.number("interface_faces") > 0))
        out.push_back("The surface vanished: no tet with a label above 0 is left.");
    for (const Check& check : validity(record)) {
        if (!check.holds) out.push_back("Not valid: " + check.name + ": " + check.value + ".");
    }
    const auto count = [&](const char* path, const std::string& one, const std::string& many) {
        const double value = record.number(path);
        if (value > 0.0) out.push_back(html::integer(value) + (value == 1.0 ? one : many));
    };
    count("input.dropped", " point of the cloud was NaN or infinite and was left out.",
          " points of the cloud were NaN or infinite and were left out.");
    count("clamped", " destination was outside the box and was moved inside.",
          " destinations were outside the box and were moved inside; use a smaller "
          "input.normalize.scale for more space.");
    if (const ordered_json* filters = find(record.summary, "input.filters");
        filters != nullptr && filters->is_array()) {
        for (const ordered_json& filter : *filters) {
            if (!filter.is_object()) continue;
            const double kept = filter.value("kept", 0.0), removed = filter.value("removed", 0.0);
            if (removed > 0.2 * (kept + removed))
                out.push_back("Filter " + filter.value("type", std::string("?")) + " removed " +
                              html::integer(removed) + " of " + html::integer(kept + removed) +
                              " points.");
        }
    }
    if (record.number("trimmed.islands") > 0)
        out.push_back("Trimming removed " + html::integer(record.number("trimmed.islands")) +
                      " small pieces of the surface.");
    const double quality = record.number("min_tet_quality");
    if (quality < 1e-3)
        out.push_back("The least tet quality is " + html::real(quality) +
                      ": some tets are nearly flat.");
    const ordered_json* labels = find(record.summary, "labels");
    const bool one_phase = labels != nullptr && !record.several_labels();
    if (record.number("components") > 1.0 && one_phase)
        out.push_back("The surface has " + html::integer(record.number("components")) +
                      " components.");
    return out;
}

}  // namespace dsc::report
