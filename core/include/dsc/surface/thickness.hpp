#pragma once
// How thick the solid is under each vertex of its surface.

#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/surface/surface_view.hpp>

namespace dsc::surface {

/// Fills `out` with the distance from each vertex, against its normal, to the first face that the ray meets, where that face looks
/// the other way by at least `opposite`, a cosine; infinity where it does not, or where none is nearer than `most`. Faces round
/// the vertex do not count. So a sheet has its thickness everywhere, and the sides of a crease have none to each other.
/// `workers`, null for one thread, share the search and do not change the result. [step]
void measure_thickness(const SurfaceView& view, double most, double opposite, std::vector<double>& out, Workers* workers = nullptr);

}  // namespace dsc::surface
