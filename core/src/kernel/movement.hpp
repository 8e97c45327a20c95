#pragma once
// Moving one interface vertex towards its destination as far as its star stays valid.

#include "kernel/workbench.hpp"

namespace dsc::kernel {

enum class Motion : std::uint8_t { arrived, moved, blocked };

/// Whether v is as close to its destination as it need be. [parallel]
bool has_arrived(const mesh::Complex& complex, const Limits& limits, VertexId v, const Vec3& destination);

/// A star tet inverts exactly when its apex crosses the plane of its link face, so the first such plane bounds the way;
/// `free_path` of it is taken, then halved until no tet falls below min(floor, its quality before). The way
/// is found, not gone: from scratch.star to scratch.place and scratch.qualities, unless it is blocked. [parallel]
Motion plan_move(const mesh::Complex& complex, const Limits& limits, VertexId v, const Vec3& destination, double free_path,
                 StarScratch& scratch);

/// Finds the way and goes it. [step]
Motion move_towards(Workbench& bench, VertexId v, const Vec3& destination, double free_path);

}  // namespace dsc::kernel
