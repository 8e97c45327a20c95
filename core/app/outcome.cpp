#include "outcome.hpp"

#include <spdlog/fmt/fmt.h>

#include <dsc/base/error.hpp>
#include <dsc/base/log.hpp>

namespace dsc::app {
namespace {

/// Where more than two labels meet, the interface as a whole is no manifold; the surface of each label is one.
void report_phase(mesh::Label label, const run::SurfaceMeasure& surface) {
    const bool solid = surface.solid();
    log(solid ? LogLevel::info : LogLevel::warning,
        fmt::format("the surface of label {} is {}closed, manifold and free of self-intersections, volume {:.6g}", label,
                    solid ? "" : "not ", surface.report.volume));
}

}  // namespace

void report(const run::RunOutcome& outcome) {
    const surface::SurfaceReport& s = outcome.surface.report;
    log(LogLevel::info,
        fmt::format("{} after {} steps: surface of {} vertices and {} faces, {} component{}, genus {}; "
                    "volume of {} tets, least "
                    "quality {:.3g}",
                    run::name(outcome.totals.status), outcome.totals.steps, s.vertices, s.faces, s.components,
                    s.components == 1 ? "" : "s", s.genus, outcome.volume.tets, outcome.volume.min_quality));
    if (outcome.surfaces.empty()) {
        log(LogLevel::warning, "the surface vanished: no tet with a label above 0 is left");
    } else if (!outcome.label_surfaces.empty()) {
        for (const auto& [label, surface] : outcome.label_surfaces) report_phase(label, surface);
    } else if (outcome.surface.solid()) {
        log(LogLevel::info, "the surface as written is closed, manifold and free of self-intersections");
    } else {
        log(LogLevel::warning, fmt::format("the surface as written has {} boundary edges, {} non-manifold "
                                           "edges, {} non-manifold vertices, {} "
                                           "self-intersections",
                                           s.boundary_edges, s.nonmanifold_edges, s.nonmanifold_vertices,
                                           outcome.surface.intersections.count));
    }
    for (const hooks::Warning& warning : outcome.totals.warnings) log(LogLevel::warning, warning.text);
    if (!outcome.report.empty()) log(LogLevel::info, "report " + outcome.report.string());
    if (outcome.totals.status == run::Status::stalled) {
        log(LogLevel::warning, "stalled: the surface could not move on; the result is what was reached");
    }
    if (outcome.totals.status == run::Status::cancelled) {
        log(LogLevel::warning, "stopped before the end of the schedule; the result is what was reached");
    }
}

int exit_code(const run::RunOutcome& outcome) {
    return static_cast<int>(outcome.totals.status == run::Status::cancelled ? ExitCode::stopped
                                                                            : ExitCode::ok);
}

}  // namespace dsc::app
