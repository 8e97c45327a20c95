#pragma once
// The constants of the fit, from the cloud's statistics and the number of the iteration.

#include <dsc/cloud/statistics.hpp>

namespace dsc::strategies::fit {

/// What the fit takes from the cloud. Lengths are in normalised units.
struct Scales {
    double width = 0.0;   ///< h: median of the point widths
    double noise = 0.0;   ///< sigma: standard deviation of the points across the surface
    double ratio = 0.0;   ///< noise over width; for even spacing small ones count as less, since there curvature reads as noise
    bool regular = false; ///< the points keep a distance from each other, as the vertices of a mesh do
    bool even = true;     ///< one width holds everywhere; otherwise lengths follow the width of the points near by
};

/// `noise` in point widths; 0: as measured. [setup]
Scales scales_of(const cloud::Statistics& statistics, double noise);

/// The constants of one iteration.
struct Stage {
    double bending = 0.0;        ///< lambda: over how many point widths the surface is smooth
    double reach = 0.0;          ///< point widths at which a point counts a quarter; at least 6 sigma
    double tangential = 0.0;     ///< hold of a vertex along the surface, in squared target lengths
    double normal = 0.0;         ///< the same across the surface
    unsigned filter_rounds = 0;  ///< of the normals
    double filter_range = 0.0;   ///< how far apart unit normals are that a filter averages
    bool attach = false;         ///< vertices go to the points that lie at them
};

/// Iterations count from 0; behind the last one its constants stay. `smoothing`, above 0, multiplies the last bending length. [step]
Stage stage_of(const Scales& scales, std::size_t iteration, std::size_t iterations, double smoothing);

/// The iteration at which holes are filled. [step]
std::size_t fill_iteration(std::size_t iterations);

}  // namespace dsc::strategies::fit
