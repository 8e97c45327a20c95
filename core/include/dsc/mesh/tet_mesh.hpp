#pragma once
// A labelled tetrahedral mesh as plain arrays: generators return it and files contain it.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::mesh {

/// Phase of a tet: 0 is outside, 1 is the object, further numbers are further phases.
using Label = std::int32_t;

/// Plain arrays. Orientation and conformity are not guaranteed until a Complex adopts them.
struct TetMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> tets;  ///< indices into points
    std::vector<Label> labels;                       ///< one per tet
};

}  // namespace dsc::mesh
