#include "strategy.hpp"

#include <cmath>

namespace dsc::strategies {
namespace {

constexpr double radians_per_degree = 0.017453292519943295;

// R - I by Rodrigues' formula, without the cancellation of R minus I for small angles.
Eigen::Matrix3d change_by_rotation(const Vec3& axis, double radians) {
    const Vec3 u = axis.normalized();
    Eigen::Matrix3d cross;
    cross << 0, -u.z(), u.y(), u.z(), 0, -u.x(), -u.y(), u.x(), 0;
    const double half_sine = std::sin(0.5 * radians);
    return std::sin(radians) * cross + 2 * half_sine * half_sine * (cross * cross);
}

}  // namespace

void Rotate::declare(config::ParamSchema<Params>& schema) {
    schema.vec3("centre", &Params::centre).unit("length").doc("Point on the axis.");
    schema.vec3("axis", &Params::axis).unit("1").doc("Direction of the axis; its length does not matter.");
    schema.real("degrees", &Params::degrees)
        .range(-180, 180)
        .unit("degrees")
        .doc("Angle per step, counter-clockwise when the axis points to the viewer.");
    schema.check([](const Params& p) { return p.axis.norm() > 1e-9; }, "axis must not be the zero vector");
}

Rotate::Rotate(const Params& params, const plugin::Setup&)
    : centre_(params.centre), change_(change_by_rotation(params.axis, params.degrees * radians_per_degree)) {}

void Rotate::prepare(const hooks::StepContext& context) { surface_ = &context.surface; }

void Rotate::evaluate(hooks::Range range, std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = displacement(surface_->positions[range.begin + i]);
}

void Rotate::sample(std::span<const Vec3> points, std::span<const Vec3>, std::span<Vec3> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = displacement(points[i]);
}

}  // namespace dsc::strategies
