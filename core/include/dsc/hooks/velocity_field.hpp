#pragma once
// Hook `velocity`: the displacement of the interface in a step.

#include <optional>

#include <dsc/hooks/attributes.hpp>
#include <dsc/hooks/context.hpp>
#include <dsc/repair/contract.hpp>

namespace dsc::hooks {

/// A displacement per interface vertex. A step calls advance() once, then prepare(), then
/// evaluate() on blocks, then publish() and, after the vertices have moved, finished().
class VelocityField : public Strategy {
public:
    ~VelocityField() override;

    /// Whether advance() and prepare() need StepContext::faces_of_points.
    virtual bool needs_faces_of_points() const { return false; }
    /// Whether advance() and prepare() need StepContext::support.
    virtual bool needs_support() const { return false; }

    /// Called exactly once per step, before prepare(). It is the only call that may change state
    /// that continues from one step to the next, which is what save() writes; it is also the place
    /// for work to be done once per step. The context outlives the evaluate() calls of the step.
    /// [step]
    virtual void advance(const StepContext& context);

    /// Called before the evaluate() and sample() calls; the context outlives them. It computes all
    /// that the answers need of this surface. It may run any number of times: once in the step, and
    /// once before each pass of a refinement that samples, then with the surface of that pass and
    /// the number of the last completed step, even before the first advance(). For the same state
    /// and context the answers must be the same, so it must not change what save() writes, and
    /// advance() must not use what it has computed. [step]
    virtual void prepare(const StepContext& context) = 0;

    /// Displacements of the vertices in `range`. `out` has range.size() entries and starts at
    /// range.begin. Entries of vertices that are not movable are ignored but must be finite. The
    /// result depends only on the prepared state. [parallel]
    virtual void evaluate(Range range, std::span<Vec3> out) const = 0;

    /// Whether sample() is available.
    virtual bool can_sample() const { return false; }
    /// The displacements of surface points with the given outward unit normals; sizes are equal.
    /// Refinement policies read it. Throws StrategyError if can_sample() is false. [parallel]
    virtual void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                        std::span<Vec3> out) const;

    /// Appends the attributes of the prepared surface. Called once per step after evaluate().
    /// [step]
    virtual void publish(Attributes& out) const;

    /// Whether the motion has ended. In a series with `until: finished` it is asked after each step
    /// and its refinement. [step]
    virtual bool finished() const { return false; }
    /// Number of the step after which finished() will be true if that is known, else 0. Contexts
    /// contain it as StepContext::planned_steps. [step]
    virtual std::uint64_t planned_steps() const { return 0; }
    /// The same as RefinementPolicy::keep_creases(), if the velocity declares the rule.
    virtual std::optional<repair::CreaseRule> keep_creases() const { return std::nullopt; }
};

}  // namespace dsc::hooks
