#include "outcome.hpp"

#include <fmt/core.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>
#include <dsc/text/words.hpp>

namespace dsc::app {
namespace {

/// Where more than two labels meet, the whole interface is not a manifold; the surface of each
/// label is one.
void report_phase(mesh::Label label, const run::SurfaceMeasure& surface) {
    const bool solid = surface.solid();
    log(solid ? LogLevel::info : LogLevel::warning,
        fmt::format("the surface of label {} is {}closed, manifold and free of self-intersections, "
                    "volume {:.6g}",
                    label, solid ? "" : "not ", surface.report.volume));
}

/// Logs how well the surface and the points agree.
void report_coverage(const run::RunOutcome& outcome) {
    if (!outcome.coverage) return;
    const run::Coverage& c = *outcome.coverage;
    log(LogLevel::info,
        fmt::format("{:.2f} % of the points are farther from the surface than noise and spacing "
                    "explain; the farthest point is {:.1f} spacings away; {:.1f} % of the surface "
                    "has no points nearby; an edge is {:.1f} spacings long",
                    100.0 * c.far_share(), c.width > 0.0 ? c.largest_distance / c.width : 0.0,
                    100.0 * c.unsupported_share, c.resolution()));
}

/// Reports a surface with a border. The surface of the volume does not have one.
void report_trimmed(const run::RunOutcome& outcome) {
    const surface::SurfaceReport& s = outcome.surface.report;
    const bool sheet = s.nonmanifold_edges == 0 && s.nonmanifold_vertices == 0 &&
                       s.misoriented_edges == 0 && outcome.surface.intersections.count == 0;
    const std::size_t count = outcome.trimmed->islands;
    const std::string islands =
        count == 0
            ? ""
            : fmt::format(", {} with it",
                          count == 1 ? "a small piece" : fmt::format("{} small pieces", count));
    log(sheet ? LogLevel::info : LogLevel::warning,
        fmt::format("the surface as written is open by request: {:.1f} % of it, which no points "
                    "support, was cut off{}; the rest is {}oriented, manifold and free of "
                    "self-intersections, in {} piece{}",
                    100.0 * outcome.trimmed->area_share, islands, sheet ? "" : "not ", s.shells,
                    s.shells == 1 ? "" : "s"));
}

}  // namespace

void report(const run::RunOutcome& outcome) {
    const surface::SurfaceReport& s = outcome.surface.report;
    const std::size_t pieces = outcome.trimmed ? s.shells : s.components;
    log(LogLevel::info,
        fmt::format("{} after {}: surface of {} vertices and {} faces, {} {}{}, genus {}; "
                    "volume of {} tets, least quality {:.3g}",
                    run::name(outcome.totals.status), text::counted(outcome.totals.steps, "step"),
                    s.vertices, s.faces, pieces, outcome.trimmed ? "piece" : "component",
                    pieces == 1 ? "" : "s", s.genus, outcome.volume.tets,
                    outcome.volume.min_quality));
    report_coverage(outcome);
    if (outcome.surfaces.empty()) {
        log(LogLevel::warning, "the surface vanished: no tet with a label above 0 is left");
    } else if (!outcome.label_surfaces.empty()) {
        for (const auto& [label, surface] : outcome.label_surfaces) report_phase(label, surface);
    } else if (outcome.trimmed) {
        report_trimmed(outcome);
    } else if (outcome.surface.solid()) {
        log(LogLevel::info,
            "the surface as written is closed, manifold and free of self-intersections");
    } else {
        log(LogLevel::warning,
            fmt::format("the surface as written has {} boundary edges, {} non-manifold edges, {} "
                        "non-manifold vertices, {} self-intersections",
                        s.boundary_edges, s.nonmanifold_edges, s.nonmanifold_vertices,
                        outcome.surface.intersections.count));
    }
    for (const hooks::Warning& warning : outcome.totals.warnings)
        log(LogLevel::warning, warning.text);
    if (!outcome.report.empty())
        log(LogLevel::info, fmt::format("report {}", outcome.report.string()));
    if (outcome.totals.status == run::Status::stalled) {
        log(LogLevel::warning, "stalled: the surface could not move further; the result contains "
                               "the state that was reached");
    }
    if (outcome.totals.status == run::Status::cancelled) {
        log(LogLevel::warning, "stopped before the end of the schedule; the result contains the "
                               "state that was reached");
    }
}

int exit_code(const run::RunOutcome& outcome) {
    return static_cast<int>(outcome.totals.status == run::Status::cancelled ? ExitCode::stopped
                                                                            : ExitCode::ok);
}

}  // namespace dsc::app
