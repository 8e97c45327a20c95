#pragma once
// Takes the interface of a labelled lattice to a surface.

#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/project.hpp>

#include "features.hpp"
#include "solid.hpp"

namespace dsc::strategies::from_surface {

/// First every vertex of the interface to its nearest point of the surface, then those near sharp edges and corners onto these.
/// No tet inverts or is taken below a volume-length quality of 0.02, unless it was there before; a vertex for which there is
/// no way stays as near as it got. [setup]
mesh::ProjectReport snap(mesh::Complex& complex, const Solid& solid, const Features& features, double cell);

}  // namespace dsc::strategies::from_surface
