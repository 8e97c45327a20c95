#pragma once
// The thickness of the solid under each vertex of its surface.

#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

/// Fills `out` with the distance from each vertex, against its normal, to the first face that the
/// ray meets. That face must face away by at least `opposite`, a cosine; else, and if no face is
/// nearer than `most`, the value is infinity. Faces round the vertex are ignored. So a thin sheet
/// has a thickness everywhere, but the two sides of a crease have none between them. `workers`,
/// null for one thread, share the search and do not change the result. [step]
void measure_thickness(const SurfaceView& view, double most, double opposite,
                       std::vector<double>& out, Workers* workers = nullptr);

}  // namespace dsc::surface
