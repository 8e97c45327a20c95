#pragma once
// How far apart the points are near each vertex, and how far a vertex is from them.

#include <vector>

#include <dsc/hooks/context.hpp>

#include "stages.hpp"
#include "surface_links.hpp"

namespace dsc::strategies::fit {

/// Distance of each vertex to its nearest point, in widths of that point. `context` has a cloud. [step]
void measure_gaps(const hooks::StepContext& context, std::vector<double>& gaps);

/// Width of the points near each vertex, in normalised units: the median of the cloud where its spacing is even; else that
/// of the nearest point, averaged over a few rings. [step]
void measure_widths(const hooks::StepContext& context, const SurfaceLinks& links, const Scales& scales, std::vector<double>& widths);

}  // namespace dsc::strategies::fit
