#pragma once
// Splits a vertex: a group of its tets receives a new vertex. New tets fill the gap between the
// two vertices.

#include <span>
#include <vector>

#include <dsc/mesh/complex.hpp>

namespace dsc::mesh {

/// A face (v, a, b), counter-clockwise seen from outside the group, between a tet of the group and
/// another tet.
struct RimFace {
    VertexId a, b;
    Label across;  ///< label outside the group
};

/// The rim of a group of v's tets in cyclic order. It is empty if the group is not a disc in v's
/// link, that is, if its rim is not one closed cycle without repeated link vertices, or lies on the
/// box. [step]
std::vector<RimFace> rim_of(const Complex& complex, VertexId v, std::span<const TetId> group);

/// The label of the tets between the two vertices.
enum class RimLabel : std::uint8_t {
    across,  ///< the label outside the group: the group is separated from v
    own,     ///< the group's label: the interface does not change
};

/// Builds the edit that gives the group a vertex v' = v + t d (method.md, section 4.6). d has the
/// largest least distance to the planes of the rim (a small linear program); t is halved from 0.3
/// of the shortest edge until every tet is exactly positive and not below min(floor, the group's
/// least quality before). False if there is no such place. [step]
bool plan_vertex_split(const Complex& complex, VertexId v, std::span<const TetId> group,
                       std::span<const RimFace> rim, RimLabel labels, double floor, Edit& edit);

}  // namespace dsc::mesh
