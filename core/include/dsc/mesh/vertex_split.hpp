#pragma once
// Splitting a vertex: a group of its tets gets a vertex of its own, the gap between the two is filled.

#include <span>
#include <vector>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// A face (v, a, b), counter-clockwise seen from outside the group, between a tet of the group and another tet.
struct RimFace {
    VertexId a, b;
    Label across;  ///< label outside the group
};

/// The rim of a group of v's tets in cyclic order; empty when the group is not a disc in v's link (its rim is not one
/// closed cycle that visits no link vertex twice, or it lies on the box). [step]
std::vector<RimFace> rim_of(const Complex& complex, VertexId v, std::span<const TetId> group);

/// Which label the tets between the two vertices get.
enum class RimLabel : std::uint8_t {
    across,  ///< that outside the group: the group lets go of v
    own,     ///< the group's: the interface stays where it is
};

/// Builds the edit that gives the group a vertex v' = v + t d: d is the direction of the largest least distance to the
/// rim's planes (a small linear program), t is halved from 0.3 of the shortest edge until every tet is exactly
/// positive and not below min(floor, the group's least quality before). False if there is no such place. [step]
bool plan_vertex_split(const Complex& complex, VertexId v, std::span<const TetId> group, std::span<const RimFace> rim,
                       RimLabel labels, double floor, Edit& edit);

}  // namespace dsc::mesh
