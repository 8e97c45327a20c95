#pragma once
// Hook `refinement`: what to split, collapse and flip between steps, and how long edges shall be.

#include <array>
#include <optional>
#include <vector>

#include <dsc/hooks/attributes.hpp>
#include <dsc/hooks/context.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/mesh/repair.hpp>

namespace dsc::hooks {

/// How often refine() is called at most within one refinement.
inline constexpr unsigned refinement_passes = 32;

/// What a refinement sees beyond a step.
struct RefinementContext {
    const StepContext& step;
    const VelocityField* velocity = nullptr;  ///< prepared for this surface where needs_sampling(), else null
    unsigned pass = 0;                        ///< of this refinement: 0 in its first call
};

/// An edge that shall become one vertex.
struct CollapseRequest {
    std::uint32_t kept = 0;     ///< view vertex that stays
    std::uint32_t removed = 0;  ///< view vertex joined to it that goes
    Vec3 place = Vec3::Zero();  ///< where `kept` shall lie then
};

/// An edge whose two faces shall get the other diagonal.
struct FlipRequest {
    std::array<std::uint32_t, 2> edge = {0, 0};  ///< joined view vertices
    double flatness = 0.995;                     ///< least cosine between the unit normals of its two faces: a sharper edge stays
};

/// A vertex that shall lie elsewhere.
struct MoveRequest {
    std::uint32_t vertex = 0;   ///< a movable view vertex
    Vec3 place = Vec3::Zero();  ///< the kernel goes there as far as no tet inverts
};

/// What it may ask for. Lengths and attributes, which are those of the view, come first, then labels, splits, collapses, flips
/// and moves. Requests that the kernel refuses are counted, not repeated.
struct RefinementRequests {
    std::vector<std::uint32_t> split_faces;                 ///< view faces: split their longest edge at its midpoint
    std::vector<std::array<std::uint32_t, 2>> split_edges;  ///< pairs of joined view vertices: split at the midpoint
    std::vector<double> sizing;                             ///< empty, or a length per view vertex: longer edges are split, once
    std::vector<std::array<std::uint32_t, 2>> relabel;      ///< (tet id, label)
    std::vector<CollapseRequest> collapse_edges;
    std::vector<FlipRequest> flip_edges;
    std::vector<MoveRequest> move_vertices;

    /// Above 0: L from now on, the same for the whole surface.
    double target_length = 0.0;
    /// Empty, or a target length per view vertex from now on, with L as their mean: carried through splits (mean) and
    /// collapses (kept end), and saved in checkpoints. Not together with `target_length`.
    std::vector<double> target_lengths;
    Attributes attributes;
};

/// Says what, the kernel owns how. [step]
class RefinementPolicy : public Strategy {
public:
    ~RefinementPolicy() override;

    /// Whether refine() calls velocity->sample(). Only then is the velocity prepared for it.
    virtual bool needs_sampling() const { return false; }
    /// Whether this refinement decides how long edges are. While its series runs, the improvement makes no size edits, and L
    /// is what the refinement says: it is not set to the mean edge after splits.
    virtual bool owns_sizing() const { return false; }
    /// Creases that no collapse, flip, relabelling or compound may remove, nor turn a face further than the rule allows, of this
    /// refinement's requests and the improvement's; asked before each step and each refinement. Of two rules the stricter
    /// bounds count. For a tet close to the kernel's quality floor the rule is set aside, which is counted.
    virtual std::optional<mesh::CreaseRule> keep_creases() const { return std::nullopt; }
    /// How often refine() is called within one refinement, from 1 to refinement_passes: each time with a fresh view, until it
    /// asks for no change of the mesh.
    virtual unsigned passes() const { return 1; }
    /// A new refinement begins where context.pass is 0.
    virtual void refine(const RefinementContext& context, RefinementRequests& out) = 0;
};

}  // namespace dsc::hooks
