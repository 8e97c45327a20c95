#pragma once
// Hook `curvature`: a signed scalar and a vector per interface vertex.

#include <dsc/hooks/context.hpp>

namespace dsc::hooks {

/// Estimates curvature at the vertices. Curvature is positive where the solid is convex.
class CurvatureEstimator : public Strategy {
public:
    ~CurvatureEstimator() override;

    /// Called before the evaluate() calls; the context outlives them. The velocity that contains
    /// the curvature calls it, so it may run any number of times per step and for several surfaces,
    /// as VelocityField::prepare(). For the same context the answers must be the same. [step]
    virtual void prepare(const StepContext& context) = 0;

    /// `scalar[i]` is the signed curvature of vertex range.begin + i. `vector[i]` is its curvature
    /// vector: scalar * outward direction (unit 1/length for mean curvatures). Both spans have
    /// range.size() entries. [parallel]
    virtual void evaluate(Range range, std::span<double> scalar, std::span<Vec3> vector) const = 0;
};

}  // namespace dsc::hooks
