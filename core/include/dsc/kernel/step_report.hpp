#pragma once
// What a step or a refinement did, in numbers.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <dsc/geometry/vec.hpp>
#include <dsc/mesh/repair.hpp>

namespace dsc::kernel {

/// Per operation: how often asked for, committed, refused by reason.
struct OperationCounts {
    std::uint64_t tried = 0;
    std::uint64_t committed = 0;
    std::array<std::uint64_t, mesh::refusal_count> refused{};

    void add(mesh::Refusal outcome);
    OperationCounts& operator+=(const OperationCounts& other);
};
using OperationTable = std::array<OperationCounts, mesh::operation_count>;
/// The same by Request::repair_class.
using RepairClassTable = std::array<OperationCounts, mesh::repair_class_limit>;

/// A topology change, a row of events.jsonl.
struct Event {
    enum class Kind : std::uint8_t { merge, split, handle_opened, handle_closed, vanished, born, unpinched };
    Kind kind = Kind::merge;
    std::uint64_t step = 0;
    Vec3 place = Vec3::Zero();  ///< centroid of the relabelled tets, normalised units
    mesh::Label label = 0;      ///< the label that they had
    std::size_t tets = 0;
    double volume = 0.0;     ///< normalised units
    double thickness = 0.0;  ///< in target lengths; 0 where it has no meaning
};
std::string_view name(Event::Kind kind);

/// CPU-independent account of one step of the Deformer.
struct StepReport {
    unsigned rounds = 0;
    std::size_t requested = 0;       ///< vertices with a displacement
    std::size_t arrived = 0;
    std::size_t clamped = 0;         ///< destinations moved back into the box shrunk by 2 L
    double dropped_motion = 0.0;     ///< summed distance to destinations that was given up
    double edit_distance = 0.0;      ///< summed movement of the interface by edits
    double edit_volume = 0.0;        ///< summed volume by which edits changed phases
    double relabelled_volume = 0.0;  ///< summed volume of relabelled tets, topology changes included
    std::uint64_t crease_exceptions = 0;  ///< edits that set the rule for creases aside, for a tet close to the quality floor
    OperationTable operations{};
    RepairClassTable repair_classes{};
    std::vector<Event> events;
    mesh::EventCounts event_counts;
    double move_seconds = 0.0;       ///< wall time, for phase_s only
    double repair_seconds = 0.0;
};

/// What Deformer::refine() did.
struct RefineReport {
    std::size_t requested = 0;
    std::size_t committed = 0;
    OperationCounts splits, collapses, flips, moves;  ///< of which these are the parts, and why the rest was refused
    bool length_changed = false;
    std::uint64_t crease_exceptions = 0;  ///< edits that set the rule aside for a tet close to the quality floor
};

}  // namespace dsc::kernel
