#pragma once
// The constants of the fit, from the cloud's statistics and the number of the iteration.

#include <dsc/cloud/statistics.hpp>

namespace dsc::strategies::fit {

/// Fraction of the iterations in which points reach twice as far and creases are not yet kept.
inline constexpr double start_part = 1.0 / 3.0;
/// Fraction of the iterations in which the bending length decreases to its last value.
inline constexpr double settling_part = 0.6;

/// The statistics of the cloud that the fit uses. Lengths are in normalised units.
struct Scales {
    double width = 0.0;    ///< h: median of the spacings
    double noise = 0.0;    ///< sigma: standard deviation of the points across the surface
    double ratio = 0.0;    ///< noise over width; for even spacing small ratios count less, since
                           ///< curvature adds to them
    bool regular = false;  ///< whether the points keep a distance from each other, like the
                           ///< vertices of a mesh
    bool even = true;      ///< whether one width is valid everywhere; otherwise lengths follow the
                           ///< widths of nearby points
};

/// `noise` in spacings; 0: as measured. [setup]
Scales scales_of(const cloud::Statistics& statistics, double noise);

/// The constants of one iteration.
struct Stage {
    double bending = 0.0;        ///< lambda: bending length, in spacings
    double reach = 0.0;          ///< spacings at which a point counts a quarter; at least 6 sigma
    double tangential = 0.0;     ///< hold of a vertex along the surface, in squared target lengths
    double normal = 0.0;         ///< the same across the surface
    unsigned filter_rounds = 0;  ///< of the normals
    double filter_range = 0.0;   ///< distance of the unit normals that the filter averages
    bool attach = false;         ///< whether vertices move to the points at them
};

/// Iterations count from 0; after the last one its constants are kept. `smoothing`, above 0,
/// multiplies the last bending length. [step]
Stage stage_of(const Scales& scales, std::size_t iteration, std::size_t iterations,
               double smoothing);

/// The iteration at which holes are filled. [step]
std::size_t fill_iteration(std::size_t iterations);

}  // namespace dsc::strategies::fit
