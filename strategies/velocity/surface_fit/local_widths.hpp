#pragma once
// The widths of the points near each vertex, and the distance of a vertex from the points.

#include <vector>

#include <dsc/hooks/context.hpp>

#include "stages.hpp"
#include "surface_links.hpp"

namespace dsc::strategies::fit {

/// Distance of each vertex to its nearest point, in widths of that point. `context` must have a
/// cloud. [step]
void measure_gaps(const hooks::StepContext& context, std::vector<double>& gaps);

/// Width of the points near each vertex, in normalised units: the median of the cloud if its
/// spacing is even; otherwise that of the nearest point, averaged over a few rings. [step]
void measure_widths(const hooks::StepContext& context, const SurfaceLinks& links,
                    const Scales& scales, std::vector<double>& widths);

}  // namespace dsc::strategies::fit
