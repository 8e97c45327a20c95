#pragma once
// Hook `curvature`: a signed scalar and a vector per interface vertex.

#include <dsc/hooks/context.hpp>

namespace dsc::hooks {

/// Estimates curvature at the vertices. Curvature is positive where the solid is convex.
class CurvatureEstimator : public Strategy {
public:
    ~CurvatureEstimator() override;

    /// Called once per step; the context outlives the evaluate() calls. [step]
    virtual void prepare(const StepContext& context) = 0;

    /// `scalar[i]` is the signed curvature of vertex range.begin + i. `vector[i]` is its curvature
    /// vector: scalar * outward direction (unit 1/length for mean curvatures). Both spans have
    /// range.size() entries. [parallel]
    virtual void evaluate(Range range, std::span<double> scalar, std::span<Vec3> vector) const = 0;
};

}  // namespace dsc::hooks
