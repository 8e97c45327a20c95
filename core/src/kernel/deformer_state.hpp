#pragma once
// The state of a Deformer, and the parts of a step, a refinement and a relabelling.

#include <dsc/base/large_vector.hpp>
#include <dsc/kernel/deformer.hpp>
#include <dsc/mesh/validate.hpp>

#include "kernel/destinations.hpp"
#include "kernel/foresights.hpp"
#include "kernel/operations.hpp"
#include "kernel/queues.hpp"
#include "kernel/topology.hpp"
#include "kernel/vertex_fields.hpp"

namespace dsc::kernel {

/// The field of the target lengths; no attribute can have this name.
inline constexpr std::string_view length_field = "target length";

struct Deformer::State {
    mesh::Complex complex;
    DeformerOptions options;
    Workbench bench;
    RepairQueues queues;
    TopologyStage topology;
    double length = 0.0;
    std::uint64_t step = 0;

    StarLoop star_loop;
    Destinations destinations;
    VertexFields fields;
    Foresights foresights;
    Workers* workers;  // null: one thread

    std::vector<repair::Request> requests, last_requests;
    std::vector<repair::Outcome> outcomes;
    LargeVector<VertexId> smoothed;  // vertices of a batch of requests
    std::vector<TetId> face_star;    // for split_longest_edge()

    State(mesh::Complex start, const DeformerOptions& wanted, Workers* given);

    void apply_limits(double flatness, const std::optional<repair::CreaseRule>& creases = {});
    /// Must be called whenever the set of fields has changed.
    void fields_changed();
    /// Sets L for the whole surface.
    void set_length(double everywhere);
    bool alive(VertexId v) const { return v < complex.vertex_slots() && complex.vertex_alive(v); }

    // ---- the parts of a step (step.cpp)
    void renew_dates();
    class Stall;
    struct Smoothing;
    void begin_step(std::span<const VertexId> vertices, std::span<const Vec3> displacements,
                    const RepairPolicy& policy, StepReport& report);
    void move_and_repair(const RepairPolicy& policy, StepReport& report);
    double make_moves();
    void repair(const RepairPolicy& policy, unsigned round, bool settled, StepReport& report);
    std::size_t find_smoothings(std::size_t first);
    std::size_t smooth_from(std::size_t first, StepReport& report);
    bool plain_smoothing(const repair::Request& request) const;
    void record(std::uint32_t i, Outcome outcome, std::uint32_t date, StepReport& report);
    void change_topology(const RepairPolicy& policy, StepReport& report);
    void sum_up(StepReport& report) const;

    // ---- the parts of a refinement (refine.cpp)
    void split_all(const RefineRequests& wanted, RefineReport& report);
    void edit_all(const RefineRequests& wanted, RefineReport& report);
    Outcome split_longest_edge(const std::array<VertexId, 3>& face);
    Outcome split(const std::array<VertexId, 2>& edge);
    Outcome collapse(const CollapseTo& request);
    Outcome flip(const FlipTo& request);
    Outcome move(const MoveTo& request);

    // ---- the parts of a relabelling (relabelling.cpp)
    /// Gives the tets their labels; `touched` receives their vertices by birth. The event describes
    /// all of them together.
    Event take_labels(std::span<const TetId> tets, std::span<const mesh::Label> labels,
                      std::vector<VertexId>& touched);
};

/// Appends a copy of the event for each shell and handle that the interface has gained or lost, and
/// for each unpinched vertex.
void append_changes(const Event& event, const mesh::InterfaceCounts& before,
                    const mesh::InterfaceCounts& after, std::size_t unpinched,
                    std::vector<Event>& events);

}  // namespace dsc::kernel
