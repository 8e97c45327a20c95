#pragma once
// Normals for shading: smooth across gentle edges, sharp across creases.

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace dsc::io {

/// Three unit normals per face, one per corner: the area-weighted mean over the faces at the
/// corner's point whose own normals are within 40 degrees of the face's normal.
std::vector<std::array<Eigen::Vector3f, 3>> shading_normals(
    const std::vector<Eigen::Vector3f>& points,
    const std::vector<std::array<std::uint32_t, 3>>& faces);

}  // namespace dsc::io
