#pragma once
// The rule for creases: which changes of the interface it forbids. Faces are judged where they are now and where the edit in
// the bench puts them.

#include "kernel/workbench.hpp"

namespace dsc::kernel {

/// Judges the linked edit in the bench: `bound` where it removes a crease or turns a face too far. Where `kept` and `removed` are
/// named, the edit is a collapse, and edges of `removed` go on as those of `kept`; a crease may be collapsed along itself where it
/// goes on. A tet below the quality floor among those that go sets the rule aside, which the bench counts. Without a rule:
/// `committed`, at no cost.
Refusal check_creases(Workbench& bench, VertexId kept = mesh::none, VertexId removed = mesh::none);

/// The same for the relabelling of tets, which is no edit.
Refusal check_creases(Workbench& bench, std::span<const TetId> tets, mesh::Label label);

}  // namespace dsc::kernel
