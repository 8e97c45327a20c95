#pragma once
// Distinguishes points strewn through space from points of a surface, in a cloud with many such
// points.

#include <vector>

#include <dsc/base/workers.hpp>

#include "remaining.hpp"

namespace dsc::cloud {

/// One flag per point of the cloud; never set for a removed point.
using Flags = std::vector<unsigned char>;

/// Points farther apart than `factor` times most points that fill space as in a ball, together with
/// their neighbours and the neighbours of these, instead of lying on a surface. [setup]
Flags strewn_points(const Remaining& cloud, double factor, Workers* workers);

/// Points off the plane of those of their neighbours that are closer together than they are
/// themselves. [setup]
Flags off_surface_points(const Remaining& cloud, Workers* workers);

/// Small groups of points that are not neighbours of other points: clumps that fill space, and
/// groups of a few points. [setup]
Flags clumps(const Remaining& cloud, Workers* workers);

}  // namespace dsc::cloud
