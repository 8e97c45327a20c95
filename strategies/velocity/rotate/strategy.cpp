// Velocity `rotate`: rotates the interface about an axis as a rigid body.
//
//     displacement = (R - I) (x - c)
//
// where R is the rotation by a fixed angle per step: vertices move along the chord to exactly the
// place where the rotation takes them [Saul2015, ch. 4, RotateFunc].
#include <cmath>

#include <dsc/base/version.hpp>
#include <dsc/hooks/velocity_field.hpp>
#include <dsc/plugin/plugin.hpp>

namespace {

using dsc::Vec3;

constexpr double radians_per_degree = 0.017453292519943295;

// R - I by Rodrigues' formula, without the cancellation of R minus I for small angles.
Eigen::Matrix3d change_by_rotation(const Vec3& axis, double radians) {
    const Vec3 u = axis.normalized();
    Eigen::Matrix3d cross;
    cross << 0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0;
    const double half_sine = std::sin(0.5 * radians);
    return std::sin(radians) * cross + 2 * half_sine * half_sine * (cross * cross);
}

class Rotate final : public dsc::hooks::VelocityField {
public:
    static constexpr dsc::hooks::Traits traits = {.rigid = false};

    /// The parameters that an experiment may set; the values here are the defaults.
    struct Params {
        Vec3 centre = Vec3::Zero();
        Vec3 axis = Vec3(0, 0, 1);
        double degrees = 1.0;
    };
    static void declare(dsc::config::ParamSchema<Params>& schema) {
        schema.vec3("centre", &Params::centre).unit("length").doc("Point on the axis.");
        schema.vec3("axis", &Params::axis)
            .unit("dimensionless")
            .doc("Direction of the axis; its length does not matter.");
        schema.real("degrees", &Params::degrees)
            .range(-180, 180, "degrees")
            .doc("Angle per step, counter-clockwise when the axis points to the viewer.");
        schema.check([](const Params& p) { return p.axis.norm() > 1e-9; },
                     "axis must not be the zero vector");
    }

    Rotate(const Params& params, const dsc::plugin::Setup&)
        : centre_(params.centre),
          change_(change_by_rotation(params.axis, params.degrees * radians_per_degree)) {}

    void prepare(const dsc::hooks::StepContext& context) override { surface_ = &context.surface; }

    void evaluate(dsc::hooks::Range range, std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = displacement(surface_->positions[range.begin + i]);
    }

    bool can_sample() const override { return true; }

    void sample(std::span<const Vec3> points, std::span<const Vec3>,
                std::span<Vec3> out) const override {
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = displacement(points[i]);
    }

private:
    Vec3 displacement(const Vec3& point) const { return change_ * (point - centre_); }

    Vec3 centre_;
    Eigen::Matrix3d change_;  // R - I
    const dsc::surface::SurfaceView* surface_ = nullptr;
};

}  // namespace

DSC_PLUGIN("rotate", DSC_VERSION, "BSD-3-Clause", "Rigid rotation of the interface") {
    registrar.add<Rotate>("rotate", "rotates the interface about an axis");
}
