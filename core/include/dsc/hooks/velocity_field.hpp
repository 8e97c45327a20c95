#pragma once
// Hook `velocity`: where the interface wants to go.

#include <dsc/hooks/context.hpp>

namespace dsc::hooks {

/// A displacement for each interface vertex. Batch-shaped: prepare() once a step, then evaluate() on blocks.
class VelocityField : public Strategy {
public:
    ~VelocityField() override;

    /// Called once before the evaluate() calls of a step; the context outlives them. [step]
    virtual void prepare(const StepContext& context) = 0;

    /// Displacements of the vertices in `range`; `out` has range.size() entries and starts at range.begin. Entries of
    /// vertices that are not movable are ignored but must be finite. Pure given the prepared state. [parallel]
    virtual void evaluate(Range range, std::span<Vec3> out) const = 0;

    /// Whether sample() works.
    virtual bool can_sample() const { return false; }
    /// The displacement that a surface point with the given outward unit normal would get; sizes are equal. Refinement
    /// policies read it. Throws StrategyError where can_sample() is false. [parallel]
    virtual void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals, std::span<Vec3> out) const;
};

}  // namespace dsc::hooks
