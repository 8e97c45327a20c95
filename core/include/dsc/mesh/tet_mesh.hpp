#pragma once
// A labelled tetrahedral mesh as plain arrays: what generators return and files hold.

#include <array>
#include <cstdint>
#include <vector>

#include <dsc/geometry/vec.hpp>

namespace dsc::mesh {

/// Material of a tet: 0 is outside, 1 the object, others further phases.
using Label = std::int32_t;

/// Plain arrays; nothing is promised about orientation or conformity until a Complex adopts them.
struct TetMesh {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 4>> tets;  ///< indices into points
    std::vector<Label> labels;                       ///< one a tet
};

}  // namespace dsc::mesh
