#pragma once
// Hook `refinement`: what to split, collapse and flip between steps, and the wanted edge lengths
// (method.md, section 7).

#include <array>
#include <optional>
#include <vector>

#include <dsc/hooks/attributes.hpp>
#include <dsc/hooks/context.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/repair/contract.hpp>

namespace dsc::hooks {

/// The largest number of calls of refine() within one refinement.
inline constexpr unsigned refinement_passes = 32;

/// What a refinement can read. It is valid until the call returns.
struct RefinementContext {
    /// The data of the last completed step, step 0 before the first one; `surface` and `volume` are
    /// those of this pass. [-; -]
    const StepContext& step;
    /// The velocity, prepared for this surface, to be read with sample(). Filled if
    /// needs_sampling() returns true, else null. [-; -]
    const VelocityField* velocity = nullptr;
    /// Pass of this refinement: 0 in the first call. [1; -]
    unsigned pass = 0;
};

/// An edge that shall become one vertex.
struct CollapseRequest {
    std::uint32_t kept = 0;     ///< view vertex that stays
    std::uint32_t removed = 0;  ///< view vertex joined to it that is removed
    Vec3 place = Vec3::Zero();  ///< position of `kept` after the collapse
};

/// An edge whose two faces shall get the other diagonal (method.md, section 4.5).
struct FlipRequest {
    std::array<std::uint32_t, 2> edge = {0, 0};  ///< joined view vertices
    double flatness = repair::default_flatness;  ///< least cosine between the normals of its faces;
                                                 ///< sharper edges stay
};

/// A vertex that shall move to another place.
struct MoveRequest {
    std::uint32_t vertex = 0;   ///< a movable view vertex
    Vec3 place = Vec3::Zero();  ///< destination; the kernel moves the vertex as far as no tet
                                ///< inverts
};

/// What a refinement may request. Lengths and attributes, which belong to the view, are set first;
/// then come labels, splits, collapses, flips and moves. Requests that the kernel refuses are
/// counted and not repeated.
struct RefinementRequests {
    std::vector<std::uint32_t> split_faces;  ///< view faces: split their longest edge at its
                                             ///< midpoint
    std::vector<std::array<std::uint32_t, 2>> split_edges;  ///< pairs of joined view vertices:
                                                            ///< split at the midpoint
    std::vector<double> sizing;  ///< empty, or a length per view vertex; longer edges are split
                                 ///< once
    std::vector<std::array<std::uint32_t, 2>> relabel;  ///< (tet id, label)
    std::vector<CollapseRequest> collapse_edges;
    std::vector<FlipRequest> flip_edges;
    std::vector<MoveRequest> move_vertices;

    /// If above 0: L from now on, the same for the whole surface.
    double target_length = 0.0;
    /// Empty, or a target length per view vertex from now on; L becomes their mean. The lengths are
    /// kept through splits (mean) and collapses (kept end), and saved in checkpoints. Must not be
    /// combined with `target_length`.
    std::vector<double> target_lengths;
    Attributes attributes;
};

/// Decides what to refine; the kernel decides how. [step]
class RefinementPolicy : public Strategy {
public:
    ~RefinementPolicy() override;

    /// Whether refine() calls velocity->sample(). The velocity is prepared for it only if this is
    /// true.
    virtual bool needs_sampling() const { return false; }
    /// Whether refine() needs StepContext::faces_of_points.
    virtual bool needs_faces_of_points() const { return false; }
    /// Whether refine() needs StepContext::support.
    virtual bool needs_support() const { return false; }
    /// Whether this refinement owns the sizing: it alone decides how long edges are. While its
    /// series runs, the improvement makes no size edits, and L is what the refinement sets; L is
    /// not set to the mean edge after splits.
    virtual bool owns_sizing() const { return false; }
    /// The rule for creases (method.md, section 4.10). It applies to collapses, flips, relabelling
    /// and compounds that this refinement or the improvement requests: they must not remove a
    /// crease or turn a face further than the rule allows. Asked before each step and each
    /// refinement. Of two rules the stricter bounds apply. For a tet close to the kernel's quality
    /// floor the rule is ignored; these cases are counted.
    virtual std::optional<repair::CreaseRule> keep_creases() const { return std::nullopt; }
    /// The largest number of calls of refine() within one refinement, from 1 to refinement_passes.
    /// Each call gets a fresh view. The calls end early when one requests no change of the mesh.
    virtual unsigned passes() const { return 1; }
    /// Appends the requests of one pass. It is called exactly once per pass, so it may change state
    /// that continues from one pass or refinement to the next. A new refinement begins if
    /// context.pass is 0. [step]
    virtual void refine(const RefinementContext& context, RefinementRequests& out) = 0;
};

}  // namespace dsc::hooks
