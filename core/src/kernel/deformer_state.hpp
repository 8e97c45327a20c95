#pragma once
// The state of a Deformer. Its functions are in deformer.cpp (a step), refinement.cpp (between steps) and deformer_state.cpp.

#include <dsc/kernel/deformer.hpp>

#include "kernel/operations.hpp"
#include "kernel/queues.hpp"
#include "kernel/topology.hpp"
#include "kernel/travels.hpp"
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
    Travels travels;
    VertexFields fields;
    Workers* workers;  // null: one thread

    std::vector<TetId> step_changes;
    std::vector<bool> noted;  // per tet: whether it is in step_changes
    std::vector<repair::Request> requests, last_requests;
    std::vector<repair::Outcome> outcomes;
    std::vector<VertexId> smoothed;  // vertices of a batch of requests

    State(mesh::Complex start, const DeformerOptions& wanted, Workers* given);

    void apply_limits(double flatness, const std::optional<repair::CreaseRule>& creases = {});
    double mean_interface_edge() const;
    /// Must be called whenever the set of fields has changed.
    void fields_changed();
    /// Sets L for the whole surface.
    void set_length(double everywhere);
    bool alive(VertexId v) const { return v < complex.vertex_slots() && complex.vertex_alive(v); }

    // ---- the parts of a step
    void begin(std::span<const VertexId> vertices, std::span<const Vec3> displacements, StepReport& report);
    void note_changes(std::span<const TetId> changed);
    void record(std::uint32_t i, Refusal refusal, std::uint32_t date, StepReport& report);
    struct Smoothing;
    bool plain_smoothing(const repair::Request& request) const;
    std::size_t smooth_from(std::size_t first, StepReport& report);
    void repair(const RepairPolicy& policy, unsigned round, bool settled, StepReport& report);
    StepReport advance(std::span<const VertexId> vertices, std::span<const Vec3> displacements, const RepairPolicy& policy);

    // ---- the parts of a refinement
    Refusal split_longest_edge(const std::array<VertexId, 3>& face);
    Refusal split(const std::array<VertexId, 2>& edge);
    Refusal collapse(const CollapseTo& request);
    Refusal flip(const FlipTo& request);
    Refusal move(const MoveTo& request);
};

}  // namespace dsc::kernel
