#pragma once
// The rule for creases: which changes of the interface it forbids (method.md, section 4.10). Faces
// are compared at their present places and at the places that the edit in the bench would give
// them.

#include "kernel/workbench.hpp"

namespace dsc::kernel {

/// Tests the linked edit in the bench: refused with `bound` if it removes a crease or turns a face
/// too far. If `kept` and `removed` are named, the edit is a collapse, and edges of `removed`
/// become edges of `kept`; an edge of a crease may be collapsed if the crease continues beyond the
/// vertices that move. If a removed tet is below `Limits::crease_floor`, the rule does not apply,
/// and the bench counts this. Without a rule it returns success at no cost.
Outcome check_creases(Workbench& bench, VertexId kept = mesh::none, VertexId removed = mesh::none);

/// The same for relabelling tets, which is not an edit.
Outcome check_creases(Workbench& bench, std::span<const TetId> tets, mesh::Label label);

}  // namespace dsc::kernel
