#pragma once
// Curvature `angular_defect`: a full turn minus the sum of the angles around a vertex.

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// 2 pi - sum of the angles at the vertex, in radians; divided by the vertex' mixed area it is the Gaussian
/// curvature [Meyer2003]. Positive on bumps and in pits alike, negative on saddles. The vector points along
/// the normal.
class AngularDefect final : public hooks::CurvatureEstimator {
public:
    struct Params {
        bool per_area = false;
    };
    static void declare(config::ParamSchema<Params>& schema);

    AngularDefect(const Params& params, const plugin::Setup& setup);

    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<double> scalar, std::span<Vec3> vector) const override;

private:
    double at(std::size_t vertex) const;

    bool per_area_;
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::strategies
