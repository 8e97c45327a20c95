#pragma once
// Moves one interface vertex towards its destination as far as its star stays valid (method.md,
// section 5.2).

#include "kernel/star_loop.hpp"
#include "kernel/workbench.hpp"

namespace dsc::kernel {

enum class Motion : std::uint8_t { arrived, moved, blocked };

/// Whether v is close enough to its destination to count as arrived. [parallel]
bool has_arrived(const mesh::Complex& complex, const Limits& limits, VertexId v,
                 const Vec3& destination);

/// A star tet inverts exactly when its apex crosses the plane of its link face, so the first such
/// plane limits the distance. The move covers `free_path` of this distance and is halved until no
/// tet falls below min(floor, its quality before). The function only plans: it reads the tets
/// of scratch.star and writes scratch.place and scratch.qualities, unless the vertex is blocked.
/// [parallel]
Motion plan_move(const mesh::Complex& complex, const Limits& limits, VertexId v,
                 const Vec3& destination, double free_path, StarScratch& scratch);

/// Plans the move and makes it. [step]
Motion move_towards(Workbench& bench, VertexId v, const Vec3& destination, double free_path);

}  // namespace dsc::kernel
