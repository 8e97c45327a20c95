#pragma once
// Velocity `normal`: the interface grows or shrinks along its normals with constant speed.

#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Displacement speed * N, where N is the outward unit normal [Saul2015, ch. 4, NormalFunc].
class Normal final : public hooks::VelocityField {
public:
    struct Params {
        double speed = 0.01;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Normal(const Params& params, const plugin::Setup& setup);

    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override;

private:
    double speed_;
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::strategies
