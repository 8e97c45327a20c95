#pragma once
// Moves the interface of a complex towards its destinations as far as no tet inverts, and repairs
// the mesh in between.

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
#include <dsc/repair/contract.hpp>

namespace dsc::kernel {

/// Limits of the kernel. Lengths are in target lengths, volumes in regular tets of edge L
/// (method.md, section 3).
struct DeformerOptions {
    double quality_floor = 1e-3;  ///< no commit leaves a touched tet below min(floor, its value
                                  ///< before)
    double free_path = 0.5;  ///< fraction of the way to the first inversion that one move may take
    unsigned max_rounds = 50;   ///< repair rounds per step
    unsigned stall_rounds = 5;  ///< rounds in which the remaining distance must fall by stall_ratio
    double stall_ratio = 0.01;
    double max_edit_distance = 0.5;  ///< largest distance by which one edit may move the interface
    double max_edit_volume = 1.0;    ///< largest volume by which one edit may change a phase
    bool audit = false;  ///< compare the queues with a full scan each round; throws GeometryError
                         ///< on a difference
    std::uint64_t drop_wake_up = 0;  ///< for tests of the audit: the n-th wake-up is dropped; 0:
                                     ///< none
};

/// The decisions that the kernel leaves to its caller.
struct RepairPolicy {
    /// Appends the requests of a round. Empty: no repair.
    std::function<void(const repair::RepairRound&, std::vector<repair::Request>&)> propose;
    /// Accepts topology candidates; empty: all are accepted.
    std::function<void(std::span<const repair::TopologyCandidate>, std::span<std::uint8_t>)> select;
    repair::TopologyLimits topology;
    double flatness = repair::default_flatness;
    bool size_edits = true;  ///< passed to `propose`: false if a refinement owns the sizing
    std::optional<repair::CreaseRule> creases;  ///< rule for creases that edits must keep; empty:
                                                ///< edits may remove any crease
    std::optional<double> quality_floor;  ///< for this step, instead of the value in the options
};

/// An edge that becomes one vertex: `kept` stays and lies at `place` afterwards.
struct CollapseTo {
    mesh::VertexId kept = mesh::none, removed = mesh::none;
    Vec3 place = Vec3::Zero();
};

/// An interface edge to be flipped; the cosine between the unit normals of its two faces must be at
/// least `flatness`.
struct FlipTo {
    mesh::VertexId a = mesh::none, b = mesh::none;
    double flatness = repair::default_flatness;
};

/// A movable vertex and its destination.
struct MoveTo {
    mesh::VertexId vertex = mesh::none;
    Vec3 place = Vec3::Zero();
};

/// What refine() shall do, in this order (method.md, section 7).
struct RefineRequests {
    std::vector<std::array<mesh::VertexId, 3>> split_faces;  ///< by its longest edge, at the
                                                             ///< midpoint
    std::vector<std::array<mesh::VertexId, 2>> split_edges;  ///< at the midpoint
    std::vector<CollapseTo> collapses;
    std::vector<FlipTo> flips;
    std::vector<MoveTo> moves;
    bool owns_sizing = false;                   ///< L is not changed by splits
    std::optional<repair::CreaseRule> creases;  ///< rule for creases that collapses and flips must
                                                ///< keep
};

/// Floor of a refinement: its collapses, flips and moves, and the splits of a refinement that owns
/// the sizing, leave no touched tet below min(this, its quality before). It is also the floor of
/// the steps of such a series, so that every tet of a written volume has at least 0.02; the rest is
/// for rounding.
inline constexpr double refinement_floor = 0.0201;

/// Owns a complex and advances it. Results do not depend on the workers' thread count.
class Deformer {
public:
    /// L becomes the mean interface edge of the complex. `workers` share the work of a step and
    /// must outlive this object; null: one thread.
    explicit Deformer(mesh::Complex complex, const DeformerOptions& options = {},
                      Workers* workers = nullptr);
    ~Deformer();
    Deformer(Deformer&&) noexcept;
    Deformer& operator=(Deformer&&) noexcept;

    const mesh::Complex& complex() const;
    /// L; constant between refinements.
    double target_length() const;
    std::uint64_t step_count() const;

    /// Sets L for the whole interface; above 0. [step]
    void set_target_length(double length);
    /// Sets a target length, above 0, for each of these vertices, which must be all interface
    /// vertices; L becomes their mean. A vertex made by a split gets the mean of the edge's ends;
    /// after a collapse the kept end keeps its length. The bounds of an edit and the limits of
    /// topology changes use the local length. Sizes are equal. [step]
    void set_target_lengths(std::span<const mesh::VertexId> vertices,
                            std::span<const double> lengths);
    /// The lengths at these interface vertices; empty if L is the same everywhere.
    std::vector<double> target_lengths(std::span<const mesh::VertexId> vertices) const;

    /// Sets a number for each of these vertices, which must be all interface vertices. Edits treat
    /// it like target lengths. Sizes are equal. [step]
    void set_attribute(std::string_view name, std::span<const mesh::VertexId> vertices,
                       std::span<const double> values);
    /// Names of the attributes in the order in which they were first set.
    std::vector<std::string> attributes() const;
    /// The value of the attribute at each of these vertices; NaN for vertices off the interface.
    /// Empty if no attribute has this name.
    std::vector<double> attribute(std::string_view name,
                                  std::span<const mesh::VertexId> vertices) const;

    /// Saves the state between two steps: the complex, lengths, attributes, the step counter, and
    /// what the kernel remembers of refusals and events. [step]
    void save(StateWriter& out) const;
    /// Continues from a saved state: its next step is the step that the saved Deformer would have
    /// made. Throws IoError "state.damaged". [setup]
    static Deformer load(StateReader& in, const DeformerOptions& options = {},
                         Workers* workers = nullptr);

    /// Makes one step: `vertices[i]` shall move by `displacements[i]` from its position now.
    /// Vertices that are not movable are ignored. Motion that cannot be reached is dropped and
    /// counted. [step]
    StepReport step(std::span<const mesh::VertexId> vertices, std::span<const Vec3> displacements,
                    const RepairPolicy& policy);

    /// Births of the vertices that did not reach their destination in the last step, in no
    /// particular order; a birth may occur twice. Valid until the next step; empty after load().
    std::span<const std::uint32_t> not_arrived() const;

    /// Skips requests whose simplex no longer exists and requests that an invariant forbids. If
    /// something was split and the sizing is not owned, L becomes the new mean interface edge, the
    /// same everywhere. [step]
    RefineReport refine(const RefineRequests& requests);
    /// The same for splits only. [step]
    RefineReport refine(std::span<const std::array<mesh::VertexId, 3>> faces,
                        std::span<const std::array<mesh::VertexId, 2>> edges);

    /// Relabels tets for a refinement (method.md, section 8.6). Tets with a box vertex are refused;
    /// irregular vertices are unpinched as in adopt. Events are appended to `events`. [step]
    std::size_t relabel(std::span<const mesh::TetId> tets, std::span<const mesh::Label> labels,
                        const RepairPolicy& policy, std::vector<Event>& events);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace dsc::kernel
