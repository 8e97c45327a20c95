#pragma once
// The colours of a cloud on the surface that was made of it.

#include <dsc/cloud/target.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::run {

/// Gives every vertex of a surface in the input's coordinates the colour of the nearest point of the cloud, which is one that
/// the cloud has: a mean would invent some. Without colours of the cloud the surface stays without. [step]
void paint(surface::TriangleMesh& surface, const cloud::TargetCloud& target);

}  // namespace dsc::run
