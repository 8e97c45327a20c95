#pragma once
// The destinations of a step: which vertices move, how destinations follow the edits, and the
// passes of movement (method.md, section 5).

#include <utility>

#include <dsc/base/large_vector.hpp>
#include <dsc/base/prefetch.hpp>
#include <dsc/kernel/step_report.hpp>

#include "kernel/movement.hpp"
#include "kernel/queues.hpp"

namespace dsc::kernel {

/// How a pass moves vertices.
struct PassOptions {
    double free_path = 0.5;  ///< fraction of the distance to the first inversion that one move may
                             ///< cover
    bool audit = false;  ///< throw GeometryError if a blocked vertex is not tried although its star
                         ///< changed
    Workers* workers = nullptr;  ///< null: one thread
};

class Destinations final : public EditListener {
public:
    Destinations(mesh::Complex& complex, RepairQueues& queues, StarLoop& loop)
        : complex_(complex), queues_(queues), loop_(loop) {}

    /// Begins a step: no vertex moves. [step]
    void clear();
    /// How many vertices got a destination.
    struct Sent {
        std::uint64_t requested = 0;  ///< movable vertices with a displacement
        std::uint64_t clamped = 0;    ///< those of them whose wanted place is not in the box
    };
    /// Gives each movable vertex that has a displacement its destination for this step: its
    /// position plus the displacement. If that point is not in the box `inside`, the nearest point
    /// of the box is the destination. Call it after clear(). `workers` is null for one thread.
    /// [step]
    Sent send(std::span<const VertexId> vertices, std::span<const Vec3> displacements,
              const Box3& inside, Workers* workers);
    /// Sets the destination of v. [step]
    void send(VertexId v, const Vec3& destination);

    /// Makes one attempt for every vertex that moves; returns the sum of the remaining distances.
    /// [step]
    double pass(const Limits& limits, const PassOptions& options);
    /// Drops the remaining motion; dropped_motion counts it. [step]
    void drop_remaining(StepReport& report);

    bool done() const { return active_.empty(); }
    /// Vertices that could not reach their destination in the last pass.
    std::span<const VertexId> blocked() const { return blocked_; }
    /// Moves attempted since clear() or the last call. [step]
    std::size_t take_tried() { return std::exchange(tried_, 0); }
    /// Number of vertices whose motion was dropped in this step.
    std::size_t stranded() const { return stranded_; }
    /// Births of the vertices that have not reached a destination of this step: those whose motion
    /// was dropped, and those that became unmovable on their way. A birth may occur twice.
    std::span<const std::uint32_t> not_arrived() const { return not_arrived_; }
    /// Kept vertices of the collapses of interface edges in this step.
    std::span<const VertexId> near_collapses() const { return near_collapses_; }

    void on_split(VertexId vertex, VertexId a, VertexId b, double s) override;
    void on_collapse(VertexId kept, VertexId removed, double s) override;
    void on_interface_collapse(VertexId kept) override { near_collapses_.push_back(kept); }

private:
    struct Entry {
        Vec3 place;
        VertexId vertex;  // none: arrived or dropped
        std::uint32_t birth;
        std::uint32_t blocked_at;  // 0: not blocked
        std::uint32_t listed;      // pass in which it was handled, to avoid double entries
    };
    struct Pass;

    Entry* entry_of(VertexId v);
    bool moves(VertexId v);
    Vec3 destination_of(VertexId v) { return moves(v) ? entry_of(v)->place : complex_.position(v); }
    void drop_dead_and_double();
    void make_room();
    void find_double(Workers* workers);
    void prefetch(VertexId v) const {
        complex_.prefetch_vertex(v);
        if (v < entry_of_vertex_.size()) prefetch_line_to_write(&entry_of_vertex_[v]);
    }

    mesh::Complex& complex_;
    RepairQueues& queues_;
    StarLoop& loop_;
    // One entry per moving vertex. `entry_of_vertex_` maps a vertex to its entry, which is valid if
    // vertex and birth agree.
    LargeVector<Entry> entries_;
    std::vector<std::uint32_t> entry_of_vertex_;
    LargeVector<VertexId> active_;
    // The shape clock at which all vertices in active_ were movable and different. As long as it
    // does not advance, they stay so.
    static constexpr std::uint32_t never = 0xffffffffU;
    std::uint32_t clean_at_ = never;
    std::vector<VertexId> blocked_;
    std::vector<VertexId> near_collapses_;
    std::vector<std::uint64_t> sent_before_;  // per block of a step's vertices: those before it
    std::uint32_t pass_ = 0;
    std::size_t tried_ = 0;
    std::size_t stranded_ = 0;
    std::vector<std::uint32_t> not_arrived_;
};

}  // namespace dsc::kernel
