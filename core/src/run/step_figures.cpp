// Figures of the state of a run.
#include "step_figures.hpp"

#include <algorithm>

#include <dsc/base/parallel_table.hpp>
#include <dsc/surface/distance.hpp>

namespace dsc::run {
namespace {

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

}  // namespace

std::vector<std::string> observer_names(const Experiment& experiment) {
    std::vector<std::string> names;
    for (const config::StrategyConfig& observer : experiment.observers) {
        std::string name = observer.type;
        for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n)
            name = observer.type + "_" + std::to_string(n);
        names.push_back(std::move(name));
    }
    return names;
}

double enclosed_volume(const surface::SurfaceView& view) {
    double sum = 0.0;
    for (std::size_t f = 0; f < view.face_count(); ++f) {
        const auto& [a, b, c] = view.faces[f];
        // A face between two labels above 0 is not counted.
        if (view.face_labels[f][0] > 0) continue;
        sum += view.positions[a].dot(view.positions[b].cross(view.positions[c]));
    }
    return sum / 6.0;
}

void measure_state(const mesh::Complex& complex, const surface::SurfaceView& view,
                   const cloud::TargetCloud* cloud, std::span<const cloud::Neighbour> nearest,
                   Workers& workers, StepMetrics& row) {
    row.interface_vertices = view.vertex_count();
    row.interface_faces = view.face_count();
    row.junction_vertices = static_cast<std::size_t>(
        std::count_if(view.vertex_ids.begin(), view.vertex_ids.end(),
                      [&](mesh::VertexId v) { return complex.phases(v) > 2; }));
    row.tets = complex.tet_count();
    row.mean_edge = view.mean_edge;
    row.volume = enclosed_volume(view);
    row.min_tet_quality = static_cast<double>(std::min(1.0F, complex.least_quality()));
    if (cloud == nullptr || view.face_count() == 0) return;

    double sum = 0.0, largest = 0.0;
    for (const cloud::Neighbour& point : nearest) {
        sum += point.distance;
        largest = std::max(largest, point.distance);
    }
    row.vertex_to_cloud_mean = sum / static_cast<double>(nearest.size());
    row.vertex_to_cloud_max = largest;

    const surface::TriangleTree tree(surface::TriangleMesh{view.positions, view.faces});
    const std::size_t probes = std::min(cloud->size(), cloud_probes);
    row.cloud_to_surface_mean = mean(parallel_table(&workers, probes, [&](std::size_t i) {
        return tree.nearest((*cloud)[i * cloud->size() / probes]).distance;
    }));
}

double measure_speeds(const surface::SurfaceView& view, std::span<const Vec3> displacements,
                      StepMetrics& row) {
    double sum = 0.0;
    std::size_t movable = 0;
    for (std::size_t i = 0; i < view.vertex_count(); ++i) {
        if (view.movable[i] == 0) continue;
        const double speed = displacements[i].norm();
        sum += speed;
        row.max_speed = std::max(row.max_speed, speed);
        ++movable;
    }
    row.mean_speed = movable == 0 ? 0.0 : sum / static_cast<double>(movable);
    return sum;
}

double distance_gone(const mesh::Complex& complex, const surface::SurfaceView& view,
                     std::span<const Vec3> displacements) {
    double sum = 0.0;
    for (std::size_t i = 0; i < view.vertex_count(); ++i) {
        if (view.movable[i] == 0) continue;
        const mesh::VertexId v = view.vertex_ids[i];
        const bool there = complex.vertex_alive(v) && complex.birth(v) == view.births[i];
        sum += there ? (complex.position(v) - view.positions[i]).norm() : displacements[i].norm();
    }
    return sum;
}

}  // namespace dsc::run
