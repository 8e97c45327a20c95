#pragma once
// What tells points strewn through space from points of a surface, in a cloud that has many such.

#include <vector>

#include <dsc/base/workers.hpp>

#include "remaining.hpp"

namespace dsc::cloud {

/// One flag per point of the cloud; none is set of a point that has gone.
using Flags = std::vector<unsigned char>;

/// Points farther apart than `factor` times most points, and with neighbours, and neighbours of these, that fill space as in a
/// ball rather than lie on a surface. [setup]
Flags strewn_points(const Remaining& cloud, double factor, Workers* workers);

/// Points that lie off the plane of those of their neighbours that lie closer together than they do themselves. [setup]
Flags off_surface_points(const Remaining& cloud, Workers* workers);

/// Small groups of points that are no neighbours of others: clumps that fill space, and groups of a few points. [setup]
Flags clumps(const Remaining& cloud, Workers* workers);

}  // namespace dsc::cloud
