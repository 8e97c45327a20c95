// Texts of summary.json and status.json.
#include "summary.hpp"

#include <nlohmann/json.hpp>

namespace dsc::run {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t most_groups = 20;

ordered_json point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

ordered_json distances(const std::optional<surface::CloudEvaluation>& figures, bool vertices) {
    if (!figures) return nullptr;
    const surface::DistanceFigures& f =
        vertices ? figures->vertex_to_cloud : figures->cloud_to_surface;
    ordered_json json = {{"mean", f.mean}};
    if (vertices) json["min"] = f.min;
    json["max"] = f.max;
    return json;
}

ordered_json events(const RunTotals& totals) {
    const kernel::EventCounts& e = totals.events;
    return {{"merge", e.merge},
            {"split", e.split},
            {"handle_opened", e.handle_opened},
            {"handle_closed", e.handle_closed},
            {"vanished", e.vanished},
            {"born", e.born},
            {"unpinched", e.unpinched + totals.adopted.unpinched_vertices}};
}

ordered_json counts_row(const kernel::OperationCounts& counts) {
    ordered_json row = {{"tried", counts.tried}, {"committed", counts.committed}};
    for (std::size_t r = 1; r < counts.refused.size(); ++r) {
        if (counts.refused[r] > 0)
            row[std::string(repair::name(static_cast<repair::Refusal>(r)))] = counts.refused[r];
    }
    return row;
}

ordered_json operations(const RunTotals& totals) {
    ordered_json table = ordered_json::object();
    for (std::size_t i = 0; i < totals.operations.size(); ++i) {
        table[std::string(repair::name(static_cast<repair::Operation>(i)))] =
            counts_row(totals.operations[i]);
    }
    return table;
}

ordered_json repair_classes(const RunTotals& totals) {
    ordered_json table = ordered_json::object();
    for (std::size_t i = 0; i < totals.repair_class_names.size(); ++i) {
        table[totals.repair_class_names[i]] = counts_row(totals.repair_classes[i]);
    }
    return table;
}

ordered_json input(const LoadedInput* loaded) {
    if (loaded == nullptr) return nullptr;
    const InputReport& report = loaded->report;
    ordered_json filters = ordered_json::array();
    for (const cloud::FilterReport& f : report.filters) {
        ordered_json row = {{"type", f.filter}, {"kept", f.kept}, {"removed", f.removed}};
        for (const cloud::RemovedPoints& removed : f.reasons)
            row["reasons"][removed.reason] = removed.count;
        for (const auto& [figure, value] : f.figures) row["figures"][figure] = value;
        for (const std::string& note : f.notes) row["notes"].push_back(note);
        filters.push_back(std::move(row));
    }
    ordered_json json = {{"source", report.source},
                         {"format", report.format},
                         {"points", report.points},
                         {"dropped", report.dropped}};
    if (report.variation) {
        json["variation"] = {{"left_out", report.variation->left_out},
                             {"jitter", report.variation->jitter},
                             {"rotated", report.variation->rotation.has_value()}};
    }
    json["filters"] = filters;
    json["used"] = report.used;
    json["diagonal"] = report.diagonal;
    return json;
}

/// From the input's units to normalised units. `rotation` has the rows of the matrix; it is left
/// out if there is none.
ordered_json transform(const cloud::Transform& to_normalised) {
    ordered_json json = {{"centre", point(to_normalised.centre)}, {"scale", to_normalised.scale}};
    if (to_normalised.rotation) {
        for (int row = 0; row < 3; ++row)
            json["rotation"].push_back(point(to_normalised.rotation->row(row).transpose()));
    }
    return json;
}

/// Volume of all labels above 0; if there are several, the interface as a whole does not enclose
/// it.
double volume_of(const SummaryParts& parts) {
    if (parts.outcome.label_surfaces.empty()) return parts.outcome.surface.report.volume;
    double sum = 0.0;
    for (const auto& [label, surface] : parts.outcome.label_surfaces) sum += surface.report.volume;
    return sum;
}

ordered_json labels(const SummaryParts& parts) {
    ordered_json all = ordered_json::object();
    for (const auto& [label, tets] : parts.outcome.volume.label_tets) {
        ordered_json row = {{"tets", tets},
                            {"volume", parts.outcome.volume.label_volumes.at(label)}};
        const auto found = parts.outcome.label_surfaces.find(label);
        if (found != parts.outcome.label_surfaces.end()) {
            const surface::SurfaceReport& s = found->second.report;
            row["surface"] = {{"vertices", s.vertices},
                              {"faces", s.faces},
                              {"components", s.components},
                              {"cavities", s.cavities},
                              {"shells", s.shells},
                              {"genus", s.genus},
                              {"closed_manifold", s.closed_manifold()},
                              {"self_intersections", found->second.intersections.count},
                              {"volume", s.volume}};
        }
        all[std::to_string(label)] = std::move(row);
    }
    return all;
}

ordered_json initial_mesh(const RunTotals& totals) {
    ordered_json figures = ordered_json::object();
    for (const auto& [figure, value] : totals.initial_mesh) figures[figure] = value;
    return figures;
}

ordered_json warnings(const RunTotals& totals) {
    ordered_json all = ordered_json::array();
    for (const hooks::Warning& warning : totals.warnings)
        all.push_back({{"code", warning.code}, {"text", warning.text}});
    return all;
}

/// CPU seconds before the first step.
ordered_json start_seconds(const SummaryParts& parts) {
    ordered_json all = {
        {"filters", parts.input == nullptr ? 0.0 : parts.input->report.filter_time.cpu}};
    for (const auto& [part, seconds] : parts.outcome.totals.initial_mesh_seconds)
        all[part] = seconds;
    all["adopt"] = parts.outcome.totals.seconds.adopt.cpu;
    return all;
}

/// The same as wall time.
ordered_json start_wall_seconds(const SummaryParts& parts) {
    return {{"filters", parts.input == nullptr ? 0.0 : parts.input->report.filter_time.wall},
            {"initial_mesh", parts.outcome.totals.seconds.initial_mesh.wall},
            {"adopt", parts.outcome.totals.seconds.adopt.wall}};
}

/// One kind of time of each phase of the steps, and of the files at the end.
ordered_json phases(const PhaseSeconds& seconds, double Seconds::*kind) {
    return {{"velocity", seconds.velocity.*kind}, {"move", seconds.move.*kind},
            {"improve", seconds.improve.*kind},   {"refine", seconds.refine.*kind},
            {"measure", seconds.measure.*kind},   {"io", seconds.io.*kind}};
}

/// Statistics of the filtered points, in normalised units.
ordered_json statistics(const LoadedInput* loaded) {
    if (loaded == nullptr) return nullptr;
    const cloud::Statistics& s = loaded->target.statistics();
    return {{"point_width", s.width},   {"label_width", s.median_label_width},
            {"width_spread", s.spread}, {"regularity", s.regularity},
            {"noise", s.noise},         {"noise_to_width", s.noise_ratio},
            {"area", s.area},           {"duplicates", s.duplicates}};
}

/// Coverage, in normalised units.
ordered_json coverage(const RunOutcome& outcome) {
    if (!outcome.coverage) return nullptr;
    const Coverage& c = *outcome.coverage;
    ordered_json groups = ordered_json::array();
    for (const PointGroup& group : c.groups) {
        if (groups.size() == most_groups) break;
        groups.push_back({{"points", group.points},
                          {"centre", point(group.centre)},
                          {"diameter", group.diameter},
                          {"farthest", group.farthest}});
    }
    return {{"far_points", c.far_points},
            {"far_share", c.far_share()},
            {"largest_distance", c.largest_distance},
            {"farthest_point", point(c.farthest_point)},
            {"groups_of_far_points", groups},
            {"unsupported_share", c.unsupported_share},
            {"mean_edge", c.mean_edge},
            {"edge_to_spacing", c.resolution()}};
}

ordered_json trimmed(const RunOutcome& outcome) {
    if (!outcome.trimmed) return nullptr;
    return {{"faces", outcome.trimmed->faces},
            {"area_share", outcome.trimmed->area_share},
            {"islands", outcome.trimmed->islands}};
}

ordered_json observers(const RunTotals& totals) {
    ordered_json all = ordered_json::object();
    for (const auto& [id, figures] : totals.observers) {
        for (const auto& [figure, value] : figures) all[id][figure] = value;
    }
    return all;
}

/// One entry per item of the schedule with a refinement.
ordered_json refinement_items(const SummaryParts& parts) {
    ordered_json all = ordered_json::array();
    for (const RefinementFigures& f : parts.outcome.totals.refinement_items) {
        all.push_back({{"item", f.item},
                       {"type", parts.loaded.experiment.schedule[f.item].refine.type},
                       {"calls", f.calls},
                       {"skipped", f.skipped},
                       {"requested", f.requested},
                       {"committed", f.committed},
                       {"vertices_made", f.made},
                       {"vertices_followed", f.followed},
                       {"vertices_present", f.present}});
    }
    return all;
}

}  // namespace

std::string summary_json(const SummaryParts& parts) {
    const RunTotals& totals = parts.outcome.totals;
    const surface::SurfaceReport& s = parts.outcome.surface.report;
    const double scale = parts.to_normalised.scale;
    const ordered_json root = {
        {"format", "dsc-summary-1"},
        {"name", parts.loaded.experiment.name},
        {"config_sha256", parts.hash},
        {"status", std::string(name(totals.status))},
        {"steps", totals.steps},
        {"interface_vertices", s.vertices},
        {"interface_faces", s.faces},
        {"junction_vertices", parts.outcome.volume.junction_vertices},
        {"tets", parts.outcome.volume.tets},
        {"min_tet_quality", parts.outcome.volume.min_quality},
        {"inverted_tets", parts.outcome.volume.inverted_tets},
        {"components", s.components},
        {"genus", s.genus},
        {"boundary_edges", s.boundary_edges},
        {"nonmanifold_edges", s.nonmanifold_edges},
        {"nonmanifold_vertices", s.nonmanifold_vertices},
        {"self_intersections", parts.outcome.surface.intersections.count},
        {"volume", volume_of(parts)},
        {"volume_initial", totals.volume_initial / (scale * scale * scale)},
        {"shells", s.shells},
        {"cavities", s.cavities},
        {"labels", labels(parts)},
        {"surface_is_interface_of_volume", parts.outcome.conforms},
        {"events", events(totals)},
        {"target_length", totals.target_length},
        {"clamped", totals.clamped},
        {"dropped_motion", totals.dropped_motion},
        {"edit_volume", totals.edit_volume},
        {"relabelled_volume", totals.relabelled_volume},
        {"crease_exceptions", totals.crease_exceptions},
        {"rounds", totals.rounds},
        {"refused",
         {{"irregular", totals.refused(repair::Refusal::irregular)},
          {"quality", totals.refused(repair::Refusal::quality)},
          {"bound", totals.refused(repair::Refusal::bound)},
          {"box", totals.refused(repair::Refusal::box)}}},
        {"vertex_to_cloud", distances(parts.distances, true)},
        {"cloud_to_surface", distances(parts.distances, false)},
        {"units", "volume and volume_initial: units of the input, cubed; every other length and "
                  "volume: normalised units, (input - centre) * scale"},
        {"to_normalised", transform(parts.to_normalised)},
        {"input", input(parts.input)},
        {"cloud", statistics(parts.input)},
        {"coverage", coverage(parts.outcome)},
        {"trimmed", trimmed(parts.outcome)},
        {"warnings", warnings(totals)},
        {"adopted",
         {{"reoriented_tets", totals.adopted.reoriented_tets},
          {"dropped_vertices", totals.adopted.dropped_vertices},
          {"unpinched_vertices", totals.adopted.unpinched_vertices},
          {"vanished_components", totals.adopted.vanished_components}}},
        {"initial_mesh", initial_mesh(totals)},
        {"refinements",
         {{"calls", totals.refinements},
          {"requested", totals.refine_requested},
          {"committed", totals.refine_committed},
          {"splits", counts_row(totals.refine_edits.splits)},
          {"collapses", counts_row(totals.refine_edits.collapses)},
          {"flips", counts_row(totals.refine_edits.flips)},
          {"moves", counts_row(totals.refine_edits.moves)},
          {"items", refinement_items(parts)}}},
        {"operations", operations(totals)},
        {"repair_classes", repair_classes(totals)},
        {"observers", observers(totals)},
        {"wall_s", parts.wall_seconds},
        {"cpu_s", parts.usage.cpu_seconds},
        {"peak_rss_mb", parts.usage.peak_rss_mb},
        {"start_cpu_s", start_seconds(parts)},
        {"start_wall_s", start_wall_seconds(parts)},
        {"phase_cpu_s", phases(totals.seconds, &Seconds::cpu)},
        {"phase_wall_s", phases(totals.seconds, &Seconds::wall)}};
    return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string status_json(const RunState& state) {
    ordered_json root = {
        {"format", "dsc-run-1"},
        {"state", state.state},
        {"config_sha256", state.hash},
        {"strategies", state.strategies},
        {"started", state.started},
        {"finished", state.finished.empty() ? ordered_json() : ordered_json(state.finished)}};
    if (state.totals) {
        root["status"] = std::string(name(state.totals->status));
        root["steps"] = state.totals->steps;
    }
    if (state.state != "running") root["exit_code"] = state.exit_code;
    if (!state.error_code.empty()) {
        root["error_code"] = state.error_code;
        root["error"] = state.error;
    }
    return root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace dsc::run
