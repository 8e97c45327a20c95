#pragma once
// The centre that a format of floats subtracts from surfaces far from the origin.

#include <dsc/surface/triangle_mesh.hpp>

namespace dsc::io {

/// Zero if floats are exact enough without it, so that ordinary models keep their coordinates:
/// if the surface is not farther from the origin than it is large. Rounded to float, so that files
/// can store it without loss.
Vec3 centre_to_subtract(const surface::TriangleMesh& mesh);

}  // namespace dsc::io
