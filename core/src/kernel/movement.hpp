#pragma once
// Moving one interface vertex towards its destination as far as its star stays valid.

#include "kernel/workbench.hpp"

namespace dsc::kernel {

enum class Motion : std::uint8_t { arrived, moved, blocked };

/// A star tet inverts exactly when its apex crosses the plane of its link face, so the first such plane bounds the way;
/// `free_path` of it is taken, then halved until no tet falls below min(floor, its quality before). [step]
Motion move_towards(Workbench& bench, VertexId v, const Vec3& destination, double free_path);

}  // namespace dsc::kernel
