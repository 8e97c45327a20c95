#pragma once
// Velocity `curvature_flow`: the interface moves by its mean curvature, like a soap film.

#include <dsc/hooks/curvature_estimator.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Displacement -2 H N dt, where H N is the curvature vector of the nested estimator: an explicit step of mean curvature flow. A
/// sphere of radius r0 has the radius sqrt(r0^2 - 4 t) at time t [Huisken1984].
class CurvatureFlow final : public hooks::VelocityField {
public:
    struct Params {
        double time_step = 1e-3;
        config::StrategyConfig curvature{"implicit_fairing", config::ConfigNode::map()};
    };
    static void declare(config::ParamSchema<Params>& schema);

    CurvatureFlow(const Params& params, const plugin::Setup& setup);

    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

private:
    double time_step_;
    std::unique_ptr<hooks::CurvatureEstimator> curvature_;
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::strategies
