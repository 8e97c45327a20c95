#pragma once
// Transfers the colours of a cloud to the surface that was made from it.

#include <dsc/cloud/target.hpp>
#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::run {

/// Gives every vertex of a surface, in the input's coordinates, the colour of the nearest point of
/// the cloud. So only colours of the cloud are used; a mean could be a new colour. If the cloud has
/// no colours, the surface gets none. [step]
void paint(surface::TriangleMesh& surface, const cloud::TargetCloud& target);

}  // namespace dsc::run
