#pragma once
// Velocity `rotate`: rotates the interface about an axis as a rigid body.

#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace dsc::strategies {

/// Displacement (R - I)(x - c), where R is the rotation by a fixed angle per step: vertices move along the chord to exactly the
/// place where the rotation takes them [Saul2015, ch. 4, RotateFunc].
class Rotate final : public hooks::VelocityField {
public:
    static constexpr hooks::Traits traits = {.rigid = false};
    struct Params {
        Vec3 centre = Vec3::Zero();
        Vec3 axis = Vec3(0, 0, 1);
        double degrees = 1.0;
    };
    static void declare(config::ParamSchema<Params>& schema);

    Rotate(const Params& params, const plugin::Setup& setup);

    void prepare(const hooks::StepContext& context) override;
    void evaluate(hooks::Range range, std::span<Vec3> out) const override;

    bool can_sample() const override { return true; }
    void sample(std::span<const Vec3> points, std::span<const Vec3> unit_normals,
                std::span<Vec3> out) const override;

private:
    Vec3 displacement(const Vec3& point) const { return change_ * (point - centre_); }

    Vec3 centre_;
    Eigen::Matrix3d change_;  // R - I
    const surface::SurfaceView* surface_ = nullptr;
};

}  // namespace dsc::strategies
