#pragma once
// Moves the interface of a complex to its destinations as far as no tet inverts, repairs the mesh, and goes on.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <dsc/base/workers.hpp>
#include <dsc/kernel/step_report.hpp>
#include <dsc/mesh/complex.hpp>
#include <dsc/mesh/repair.hpp>

namespace dsc::kernel {

/// Limits of the kernel; lengths in target lengths, volumes in regular tets of edge L.
struct DeformerOptions {
    double quality_floor = 1e-3;     ///< no commit leaves a touched tet below min(floor, its value before)
    double free_path = 0.5;          ///< fraction of the way to the first inversion that one move may take
    unsigned max_rounds = 50;        ///< repair rounds a step
    unsigned stall_rounds = 5;       ///< rounds in which the distance left must fall by stall_ratio
    double stall_ratio = 0.01;
    double max_edit_distance = 0.5;  ///< by which one edit may move the interface
    double max_edit_volume = 1.0;    ///< by which one edit may change a phase
    bool audit = false;              ///< compare the queues with a full scan each round; throws GeometryError on a difference
    std::uint64_t drop_wake_up = 0;  ///< for tests of the audit: the n-th wake-up is lost; 0: none is
};

/// The decisions that the kernel leaves to others.
struct RepairPolicy {
    /// Appends the requests of a round. Empty: no repair.
    std::function<void(const mesh::RepairRound&, std::vector<mesh::Request>&)> propose;
    /// Accepts topology candidates; empty: all are accepted.
    std::function<void(std::span<const mesh::TopologyCandidate>, std::span<std::uint8_t>)> select;
    mesh::TopologyLimits topology;
    double flatness = 0.995;
    bool size_edits = true;  ///< told to `propose`: false where a refinement owns the sizing
    std::optional<mesh::CreaseRule> creases;  ///< that edits leave; empty: they may remove any
    std::optional<double> quality_floor;      ///< of this step, instead of the one of the options
};

/// Edge to become one vertex: `kept` stays and lies at `place` then.
struct CollapseTo {
    mesh::VertexId kept = mesh::none, removed = mesh::none;
    Vec3 place = Vec3::Zero();
};

/// Interface edge to take the other diagonal of its two faces, whose unit normals have at least this cosine between them.
struct FlipTo {
    mesh::VertexId a = mesh::none, b = mesh::none;
    double flatness = 0.995;
};

/// Movable vertex to lie elsewhere.
struct MoveTo {
    mesh::VertexId vertex = mesh::none;
    Vec3 place = Vec3::Zero();
};

/// What refine() shall do, in this order.
struct RefineRequests {
    std::vector<std::array<mesh::VertexId, 3>> split_faces;  ///< longest edge, midpoint
    std::vector<std::array<mesh::VertexId, 2>> split_edges;  ///< midpoint
    std::vector<CollapseTo> collapses;
    std::vector<FlipTo> flips;
    std::vector<MoveTo> moves;
    bool owns_sizing = false;  ///< L stays what it is, whatever is split
    std::optional<mesh::CreaseRule> creases;  ///< that collapses and flips leave
};

/// No collapse, flip or move of a refinement, and no split of one that owns the sizing, leaves a touched tet below
/// min(this, its quality before). Steps that such a refinement goes with have it as their floor too, so that a volume that is
/// written has 0.02 at least; the rest is for rounding.
inline constexpr double refinement_floor = 0.0201;

/// Owns a complex and advances it. Results do not depend on the workers' thread count.
class Deformer {
public:
    /// L becomes the mean interface edge of the complex. `workers`, which must live longer, share the work of a step; null: one
    /// thread.
    explicit Deformer(mesh::Complex complex, const DeformerOptions& options = {}, Workers* workers = nullptr);
    ~Deformer();
    Deformer(Deformer&&) noexcept;
    Deformer& operator=(Deformer&&) noexcept;

    const mesh::Complex& complex() const;
    /// L: constant between refinements.
    double target_length() const;
    std::uint64_t step_count() const;

    /// L from now on, the same everywhere; above 0. [step]
    void set_target_length(double length);
    /// A target length, above 0, for each of these vertices, which are those of the interface; L becomes their mean. A vertex
    /// made by a split gets the mean of the edge's ends, after a collapse the kept end's length stays. All bounds of an edit,
    /// and the limits of topology changes, read the length at their place. Sizes are equal. [step]
    void set_target_lengths(std::span<const mesh::VertexId> vertices, std::span<const double> lengths);
    /// The lengths at these interface vertices; empty where L is the same everywhere.
    std::vector<double> target_lengths(std::span<const mesh::VertexId> vertices) const;

    /// A number for each of these vertices, those of the interface, carried on like target lengths. Sizes are equal. [step]
    void set_attribute(std::string_view name, std::span<const mesh::VertexId> vertices, std::span<const double> values);
    /// Names, in the order in which they were set first.
    std::vector<std::string> attributes() const;
    /// The value of the attribute at each of these vertices, NaN off the interface; empty if no attribute has this name.
    std::vector<double> attribute(std::string_view name, std::span<const mesh::VertexId> vertices) const;

    /// Between steps: the complex, lengths, attributes, the step counter, and what the kernel remembers of refusals and
    /// events. [step]
    void save(StateWriter& out) const;
    /// The saved one goes on: its next step is the one that it would have been. Throws IoError "state.damaged". [setup]
    static Deformer load(StateReader& in, const DeformerOptions& options = {}, Workers* workers = nullptr);

    /// One step: `vertices[i]` wants to move by `displacements[i]`, counted from where it is now; not movable vertices
    /// are ignored. The rest of the motion that cannot be reached is dropped and counted. [step]
    StepReport step(std::span<const mesh::VertexId> vertices, std::span<const Vec3> displacements,
                    const RepairPolicy& policy);

    /// Requests whose simplex is gone by their turn are skipped, as are those that an invariant forbids. If anything was split
    /// and the sizing is not owned, L becomes the new mean interface edge, the same everywhere. [step]
    RefineReport refine(const RefineRequests& requests);
    /// The same for splits alone. [step]
    RefineReport refine(std::span<const std::array<mesh::VertexId, 3>> faces,
                        std::span<const std::array<mesh::VertexId, 2>> edges);

    /// Relabels tets at a plugin's request: box vertices and irregular results refused or unpinched as in adopt; events
    /// go to `events`. [step]
    std::size_t relabel(std::span<const mesh::TetId> tets, std::span<const mesh::Label> labels,
                        const RepairPolicy& policy, std::vector<Event>& events);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace dsc::kernel
