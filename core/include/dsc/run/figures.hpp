#pragma once
// The figures of a run: the lines of events.jsonl, and the sums that summary.json contains.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <dsc/base/stopwatch.hpp>
#include <dsc/cloud/normalize.hpp>
#include <dsc/hooks/figures.hpp>
#include <dsc/kernel/step_report.hpp>
#include <dsc/mesh/adopt.hpp>

namespace dsc::run {

/// How a run ended.
enum class Status { converged, max_steps, stalled, cancelled };
std::string_view name(Status status);

/// A line of events.jsonl: place and volume in the input's units, with its newline.
std::string event_line(const kernel::Event& event, const cloud::Transform& to_normalised);

/// Requests of one class in one step; see hooks::Improvement::repair_classes().
struct ClassFigures {
    std::uint64_t step = 0;
    std::string_view repair_class;
    std::uint64_t requested = 0;
    std::uint64_t committed = 0;
};
/// A line of events.jsonl, with its newline.
std::string class_line(const ClassFigures& figures);

/// Time by phase.
struct PhaseSeconds {
    Seconds initial_mesh, adopt;  ///< before the first step
    Seconds velocity, move, improve, refine, measure, io;
};

/// What refinements requested from the kernel, and the outcomes.
struct RefinementCounts {
    kernel::OperationCounts splits, collapses, flips, moves;
    void add(const kernel::RefineReport& report);
};

/// Number of steps after which the vertices that a refinement made are counted again.
inline constexpr std::uint64_t refinement_watch_steps = 5;

/// What the refinement of one item of the schedule did, over all its calls.
struct RefinementFigures {
    std::uint64_t item = 0;       ///< index in the schedule
    std::uint64_t calls = 0;      ///< number of times that it ran
    std::uint64_t skipped = 0;    ///< number of times that it was skipped after the last step
    std::uint64_t requested = 0;  ///< changes of the mesh that it asked for
    std::uint64_t committed = 0;  ///< those of them that were made
    std::uint64_t made = 0;  ///< vertices born while it ran that lay on the interface at its end
    std::uint64_t followed = 0;  ///< those of them that were made at least refinement_watch_steps
                                 ///< steps before the end of the run
    std::uint64_t present = 0;   ///< those of the followed ones that were still on the interface
                                 ///< refinement_watch_steps steps later
};

/// Sums over all steps, normalised units.
struct RunTotals {
    std::uint64_t steps = 0;
    Status status = Status::max_steps;
    double volume_initial = 0.0;
    double target_length = 0.0;
    std::uint64_t rounds = 0;
    std::uint64_t requested = 0;
    std::uint64_t arrived = 0;
    std::uint64_t clamped = 0;
    double dropped_motion = 0.0;
    double edit_distance = 0.0;
    double edit_volume = 0.0;
    double relabelled_volume = 0.0;
    std::uint64_t crease_exceptions = 0;
    std::uint64_t refinements = 0;
    std::uint64_t refine_requested = 0;
    std::uint64_t refine_committed = 0;
    RefinementCounts refine_edits;
    std::vector<RefinementFigures> refinement_items;  ///< one per item with a refinement; filled at
                                                      ///< the end of the run
    kernel::OperationTable operations{};
    kernel::RepairClassTable repair_classes{};
    std::vector<std::string> repair_class_names;  ///< names of the first entries of repair_classes
    kernel::EventCounts events;
    mesh::AdoptReport adopted;
    hooks::Figures initial_mesh;          ///< from the generator
    hooks::Figures initial_mesh_seconds;  ///< CPU seconds of the generator's parts
    hooks::Warnings warnings;             ///< from the strategies
    PhaseSeconds seconds;
    std::vector<std::pair<std::string, hooks::Figures>> observers;  ///< by observer id, from its
                                                                    ///< end()

    void add(const kernel::StepReport& report);
    /// Refused operations by reason, over all operations.
    std::uint64_t refused(repair::Refusal reason) const;
};

}  // namespace dsc::run
