#pragma once
// Hook `velocity`: where the interface wants to go.

#include <optional>

#include <dsc/hooks/attributes.hpp>
#include <dsc/hooks/context.hpp>
#include <dsc/mesh/repair.hpp>

namespace dsc::hooks {

/// A displacement for each interface vertex. A step calls advance() once, then prepare(), then evaluate() on blocks, then
/// publish() and, once the vertices have moved, finished().
class VelocityField : public Strategy {
public:
    ~VelocityField() override;

    /// Whether advance() and prepare() want StepContext::faces_of_points.
    virtual bool needs_faces_of_points() const { return false; }

    /// Called exactly once per step, before prepare(): the place for state that goes from one step to the next, and for
    /// work that shall be done once per step. The context outlives the step's evaluate() calls. [step]
    virtual void advance(const StepContext& context);

    /// Called before the evaluate() and sample() calls that it is for; the context outlives them. It may be called more than
    /// once per step, for a refinement that samples too, and then gives the same answers for the same surface: it must not
    /// change what save() writes. [step]
    virtual void prepare(const StepContext& context) = 0;

    /// Displacements of the vertices in `range`; `out` has range.size() entries and starts at range.begin. Entries of
    /// vertices that are not movable are ignored but must be finite. Pure given the prepared state. [parallel]
    virtual void evaluate(Range range, std::span<Vec3> out) const = 0;

    /// Whether sample() works.
    virtual bool can_sample() const { return false; }
    /// The displacement that a surface point with the given outward unit normal would get; sizes are equal. Refinement
    /// policies read it. Throws StrategyError where can_sample() is false. [parallel]
    virtual void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals, std::span<Vec3> out) const;

    /// Appends the attributes of the prepared surface, called once per step after evaluate(). [step]
    virtual void publish(Attributes& out) const;

    /// Whether the motion has come to its end: asked after each step and the refinement that belongs to it, in a series with
    /// `until: finished`. [step]
    virtual bool finished() const { return false; }
    /// Number of the step after which finished() will be true, where that is known; 0 otherwise. Contexts tell it as
    /// StepContext::planned_steps. [step]
    virtual std::uint64_t planned_steps() const { return 0; }
    /// As RefinementPolicy::keep_creases(), where the velocity declares it.
    virtual std::optional<mesh::CreaseRule> keep_creases() const { return std::nullopt; }
};

}  // namespace dsc::hooks
