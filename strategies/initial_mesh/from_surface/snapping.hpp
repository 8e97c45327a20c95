#pragma once
// Moves the interface of a labelled lattice onto a surface.

#include <dsc/generate/project.hpp>
#include <dsc/mesh/complex.hpp>

#include "features.hpp"
#include "solid.hpp"

namespace dsc::strategies::from_surface {

/// First moves every vertex of the interface to its nearest point of the surface, then vertices
/// near sharp edges and corners onto these. No tet inverts or gets a volume-length quality below
/// 0.02, unless it was lower before; a vertex that cannot get there stays at the nearest place that
/// it reached. [setup]
generate::ProjectReport snap(mesh::Complex& complex, const Solid& solid, const Features& features,
                             double cell);

}  // namespace dsc::strategies::from_surface
