#pragma once
// Figures of a step or a refinement (method.md, section 9).

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <dsc/base/stopwatch.hpp>
#include <dsc/geometry/vec.hpp>
#include <dsc/repair/contract.hpp>

namespace dsc::kernel {

/// Per operation: how often it was requested, committed, and refused by reason.
struct OperationCounts {
    std::uint64_t tried = 0;
    std::uint64_t committed = 0;
    std::array<std::uint64_t, repair::refusal_count> refused{};

    void add(repair::Outcome outcome) {
        ++tried;
        ++(outcome.refused() ? refused[static_cast<std::size_t>(outcome.reason())] : committed);
    }
    OperationCounts& operator+=(const OperationCounts& other);
};
using OperationTable = std::array<OperationCounts, repair::operation_count>;
/// The same per Request::repair_class.
using RepairClassTable = std::array<OperationCounts, repair::repair_class_limit>;

/// A change of topology; one line of events.jsonl.
struct Event {
    enum class Kind : std::uint8_t {
        merge,
        split,
        handle_opened,
        handle_closed,
        vanished,
        born,
        unpinched
    };
    Kind kind = Kind::merge;
    std::uint64_t step = 0;
    Vec3 place = Vec3::Zero();  ///< centroid of the relabelled tets, normalised units
    mesh::Label label = 0;      ///< label of the tets before
    std::size_t tets = 0;
    double volume = 0.0;     ///< normalised units
    double thickness = 0.0;  ///< in target lengths; 0 if it does not apply
};
std::string_view name(Event::Kind kind);

/// Number of events per kind.
struct EventCounts {
    std::uint64_t merge = 0, split = 0, handle_opened = 0, handle_closed = 0, vanished = 0,
                  born = 0, unpinched = 0;

    void add(Event::Kind kind);
    EventCounts& operator+=(const EventCounts& other);
};

/// What one step of the Deformer did; the counts do not depend on the CPU.
struct StepReport {
    unsigned rounds = 0;
    std::size_t requested = 0;  ///< vertices with a displacement
    std::size_t arrived = 0;
    std::size_t clamped = 0;         ///< destinations moved back into the box shrunk by 2 L
    double dropped_motion = 0.0;     ///< sum of the distances to destinations that were not reached
    double edit_distance = 0.0;      ///< sum of the distances by which edits moved the interface
    double edit_volume = 0.0;        ///< sum of the volumes by which edits changed phases
    double relabelled_volume = 0.0;  ///< sum of the volumes of relabelled tets, topology changes
                                     ///< included
    std::uint64_t crease_exceptions = 0;  ///< edits that ignored the rule for creases because a tet
                                          ///< was close to the quality floor
    OperationTable operations{};
    RepairClassTable repair_classes{};
    std::vector<Event> events;
    EventCounts event_counts;
    Seconds move_time, repair_time;
};

/// What Deformer::refine() did.
struct RefineReport {
    std::size_t requested = 0;
    std::size_t committed = 0;
    OperationCounts splits, collapses, flips, moves;  ///< counts of each kind of request, and why
                                                      ///< requests were refused
    bool length_changed = false;
    std::uint64_t crease_exceptions = 0;  ///< edits that ignored the rule because a tet was close
                                          ///< to the quality floor
};

}  // namespace dsc::kernel
