#pragma once
// Figures of the state of a run, for a row of metrics.csv.

#include <span>
#include <string>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/cloud/target.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/run/experiment.hpp>
#include <dsc/run/metrics.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::run {

/// The names of the observers in figures: their types. The second one of a type is TYPE_2, and so
/// on.
std::vector<std::string> observer_names(const Experiment& experiment);

/// Fills the figures that depend only on the state: sizes, mean edge, distances, volume, quality.
/// `cloud` may be null; `nearest` contains the nearest cloud point of each view vertex.
void measure_state(const mesh::Complex& complex, const surface::SurfaceView& view,
                   const cloud::TargetCloud* cloud, std::span<const cloud::Neighbour> nearest,
                   Workers& workers, StepMetrics& row);

/// Fills the speeds of a step, for the movable vertices; returns their sum.
double measure_speeds(const surface::SurfaceView& view, std::span<const Vec3> displacements,
                      StepMetrics& row);

/// Sum of the distances that the movable vertices of the view have moved since it was made; a
/// vertex that an edit removed counts with its whole displacement.
double distance_gone(const mesh::Complex& complex, const surface::SurfaceView& view,
                     std::span<const Vec3> displacements);

/// Volume of all labels above 0 by the divergence theorem over the interface; the cost grows only
/// with the interface.
double enclosed_volume(const surface::SurfaceView& view);

}  // namespace dsc::run
